#include "app/exit_code.h"

#include <cerrno>
#include <cstring>
#include <new>
#include <string_view>
#include <system_error>

#include "app/console.h"
#include "core/error.h"

namespace lancer {

namespace {

int exit_code_of(ErrorKind kind)
{
    switch (kind) {
        case ErrorKind::failed:
            return exit_failed;
        case ErrorKind::usage:
            return exit_usage;
        case ErrorKind::invalid_input:
            return exit_invalid;
        case ErrorKind::missing_input:
            return exit_missing;
        case ErrorKind::no_memory:
            return exit_no_memory;
    }
    return exit_failed;
}

}  // namespace

Failure current_failure()
{
    try {
        throw;
    } catch (const Error& e) {
        return {exit_code_of(e.kind()), e.what()};
    } catch (const std::bad_alloc&) {
        return {exit_failed, "error: out of memory"};
    } catch (const std::exception& e) {
        return {exit_failed, std::string("error: ") + e.what()};
    }
}

int guarded(const std::function<int()>& body)
{
    try {
        const int code = body();
        flush_results();
        return code;
    } catch (const std::exception&) {
        const Failure failure = current_failure();
        print_problem(failure.text);
        return failure.code;
    }
}

std::string message_of_termination(const std::exception_ptr& thrown)
{
    if (!thrown) return "error: a library failed";
    const std::string_view advice = "; fewer --threads need less of memory and processes";
    const auto with_advice = [&](const char* what, bool helps) {
        return std::string("error: ") + what + std::string(helps ? advice : "");
    };
    try {
        std::rethrow_exception(thrown);
    } catch (const std::bad_alloc&) {
        return with_advice("out of memory", true);
    } catch (const std::system_error& e) {
        return with_advice(e.what(), e.code() == std::errc::resource_unavailable_try_again ||
                                         e.code() == std::errc::not_enough_memory);
    } catch (const std::exception& e) {
        // TBB has the words of the system and no number.
        const std::string_view what = e.what();
        const auto says = [&](int number) { return what.find(std::strerror(number)) != std::string_view::npos; };
        return with_advice(e.what(), says(EAGAIN) || says(ENOMEM));
    } catch (...) {
        return "error: a library failed";
    }
}

}  // namespace lancer
