// A list of types for typed tests: all alternatives of a variant.
#pragma once

#include <gtest/gtest.h>

#include <variant>

namespace lancer {

template <class V>
struct Alternatives;
template <class... M>
struct Alternatives<std::variant<M...>> {
    using Types = testing::Types<M...>;
};

}  // namespace lancer
