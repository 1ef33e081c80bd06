// Values that are made where they stay.
#pragma once

#include <type_traits>

namespace lancer {

// For emplace(): what f() returns is made in place. What is large and copied as a whole right after
// it was written in parts would wait for all that came before.
template <class F>
struct Made {
    const F& f;
    operator std::invoke_result_t<F>() const { return f(); }
};

}  // namespace lancer
