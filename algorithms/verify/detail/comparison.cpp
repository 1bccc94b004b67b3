// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/verify/detail/comparison.hpp>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <utility>

#include <terrane/algorithms/verify/stoppable.hpp>

namespace terrane::verifier {

namespace {

/// Returns the line of a text that has the byte at a place, or what follows it, for people to read.
std::string excerpt(std::string_view text, std::size_t at) {
    constexpr std::size_t most = 40;
    const std::size_t start = at == 0 ? 0 : text.rfind('\n', at - 1) + 1;
    const std::string_view shown = text.substr(at - start < most ? start : at);
    return "\"" + std::string(shown.substr(0, std::min(shown.find('\n'), most))) + "\"";
}

} // namespace

Comparison& Comparison::operator<<(std::string_view text) {
    look_for_stop();
    const std::string_view here = rest();
    if (here.starts_with(text)) {
        at_ += text.size();
        return *this;
    }
    const auto wrong =
        static_cast<std::size_t>(std::ranges::mismatch(text, here).in1 - text.begin());
    at_ += wrong;
    if (at_ == file_.size()) fail("the file ends too early");
    const bool is_text = text.find_first_of(std::string_view("\0", 1)) == std::string_view::npos;
    fail(text[wrong] == '\n' ? "the line must end here"
         : is_text           ? excerpt(text, wrong) + " is needed"
                             : "another byte is needed");
}

template <class Number>
requires std::unsigned_integral<Number> || std::floating_point<Number> Comparison&
Comparison::operator<<(Number number) {
    std::array<char, 64> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
    return *this << std::string_view(digits.data(), static_cast<std::size_t>(end - digits.data()));
}

template Comparison& Comparison::operator<<(double);
template Comparison& Comparison::operator<<(float);
template Comparison& Comparison::operator<<(unsigned int);
template Comparison& Comparison::operator<<(unsigned long);
template Comparison& Comparison::operator<<(unsigned long long);

void Comparison::end() const {
    if (at_ != file_.size()) fail("the file must end here");
}

void Comparison::fail(std::string sentence) const {
    const std::string_view before = file_.substr(0, at_);
    const bool is_text = before.find('\0') == std::string_view::npos;
    const std::string line =
        is_text ? "line " + std::to_string(1 + std::ranges::count(before, '\n')) + ", " : "";
    throw Difference{line + "byte " + std::to_string(at_ + 1), std::move(sentence)};
}

} // namespace terrane::verifier
