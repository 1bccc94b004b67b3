// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <terrane/algorithms/judge/judge.hpp>

namespace terrane::judging {

/// Collects the flaws of one property.
class Flaws {
public:
    Flaws(std::string name, std::size_t most) : most_(most) { property_.name = std::move(name); }

    /// in_doubt: features of the exact result that are thinner than the bound may be why.
    void add(PropertyFlaw flaw, bool in_doubt = false) {
        if (!in_doubt) property_.verdict = PropertyVerdict::fails;
        if (property_.verdict == PropertyVerdict::holds)
            property_.verdict = PropertyVerdict::not_judged;
        if (++property_.count <= most_) property_.flaws.push_back(std::move(flaw));
    }
    [[nodiscard]] std::size_t count() const { return property_.count; }
    /// Returns the property with a sentence, and a size that belongs to it.
    [[nodiscard]] JudgedProperty said(std::string sentence, double size = 0) {
        property_.sentence = std::move(sentence);
        property_.size = size;
        return std::move(property_);
    }

private:
    std::size_t most_;
    JudgedProperty property_;
};

/// Returns "1 flaw", "2 flaws".
inline std::string counted_as(std::size_t count, std::string_view one, std::string_view many) {
    return std::to_string(count) + " " + std::string(count == 1 ? one : many);
}

} // namespace terrane::judging
