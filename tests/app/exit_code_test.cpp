// What is said of exceptions that nothing catches: advice only where it helps.
#include "app/exit_code.h"

#include <gtest/gtest.h>

#include <new>
#include <stdexcept>
#include <system_error>

namespace lancer {
namespace {

template <class E>
std::string said_of(const E& e)
{
    return message_of_termination(std::make_exception_ptr(e));
}
bool advises(const std::string& message) { return message.find("fewer --threads") != std::string::npos; }

TEST(Termination, FewerThreadsAreAdvisedWhereMemoryOrThreadsRunOut)
{
    EXPECT_TRUE(advises(said_of(std::bad_alloc())));
    EXPECT_TRUE(advises(said_of(std::system_error(std::make_error_code(std::errc::resource_unavailable_try_again)))));
    EXPECT_TRUE(advises(said_of(std::system_error(std::make_error_code(std::errc::not_enough_memory)))));
    // As TBB has it.
    EXPECT_TRUE(advises(said_of(std::runtime_error("pthread_create has failed: Resource temporarily unavailable"))));
}

TEST(Termination, AndNotOfAnythingElse)
{
    const std::string said = said_of(std::logic_error("the scene has no end"));
    EXPECT_EQ(said, "error: the scene has no end");
    EXPECT_FALSE(advises(said_of(std::system_error(std::make_error_code(std::errc::no_such_file_or_directory)))));
    EXPECT_FALSE(advises(said_of(7)));
    EXPECT_EQ(message_of_termination({}), "error: a library failed");
}

}  // namespace
}  // namespace lancer
