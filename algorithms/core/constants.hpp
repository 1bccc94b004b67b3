// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Constants of a stage, each of which is declared once, with its name.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

#include <terrane/algorithms/core/fields.hpp>

namespace terrane {

/// Base of a struct whose members are constants: `double share = add("share", 0.5);`. It lists them
/// in the order of their declaration. With more than there is room for, it does not compile.
class Constants {
public:
    [[nodiscard]] std::vector<NamedConstant> listed() const {
        return {all_.data(), all_.data() + count_};
    }

protected:
    template <class T>
    constexpr T add(std::string_view name, T value) {
        all_.at(count_++) = {name, static_cast<double>(value)};
        return value;
    }
    template <class T, std::size_t count>
    constexpr std::array<T, count> add(const std::string_view (&names)[count],
                                       const T (&values)[count]) {
        std::array<T, count> made{};
        for (std::size_t i = 0; i < count; ++i) made[i] = add(names[i], values[i]);
        return made;
    }

private:
    std::array<NamedConstant, 100> all_{};
    std::size_t count_ = 0;
};

} // namespace terrane
