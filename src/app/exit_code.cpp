#include "app/exit_code.h"

#include <exception>
#include <new>
#include <string>

#include "app/console.h"
#include "core/error.h"

namespace lancer {
namespace {

int exit_code(ErrorKind kind)
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
    }
    return exit_failed;
}

}  // namespace

int guarded(const std::function<int()>& body)
{
    try {
        const int code = body();
        flush_results();
        return code;
    } catch (const Error& e) {
        print_problem(e.what());
        return exit_code(e.kind());
    } catch (const std::bad_alloc&) {
        print_problem("error: out of memory");
    } catch (const std::exception& e) {
        print_problem(std::string("error: ") + e.what());
    }
    return exit_failed;
}

}  // namespace lancer
