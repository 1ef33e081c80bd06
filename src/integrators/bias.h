// What the pictures of an integrator lack by its nature, whatever its settings: an entry of the bias ledger.
#pragma once

#include <string_view>

namespace lancer {

struct IntegratorBias {
    std::string_view entry, effect;
};

}  // namespace lancer
