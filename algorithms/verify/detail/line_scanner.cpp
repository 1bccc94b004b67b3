// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/verify/detail/line_scanner.hpp>

#include <bit>
#include <charconv>
#include <utility>

#include <terrane/algorithms/verify/detail/decimal.hpp>
#include <terrane/algorithms/verify/stoppable.hpp>

namespace terrane::verifier {

std::string_view name_of(Role role) {
    switch (role) {
    case Role::horizon:
        return "horizon";
    case Role::fault:
        return "fault";
    case Role::boundary:
        return "boundary";
    case Role::unknown:
        break;
    }
    return "unknown";
}

bool same_bits(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

bool same_bits(const Point3& a, const Point3& b) {
    return same_bits(a.x, b.x) && same_bits(a.y, b.y) && same_bits(a.z, b.z);
}

void LineScanner::fail(std::string sentence) const {
    throw Difference{"line " + std::to_string(number_), std::move(sentence)};
}

std::string_view LineScanner::next() {
    look_for_stop();
    ++number_;
    const std::size_t end = rest_.find('\n');
    if (end == std::string_view::npos) fail("the file ends too early");
    line_ = rest_.substr(0, end);
    rest_.remove_prefix(end + 1);
    first_word_ = true;
    return line_;
}

void LineScanner::expect(std::string_view line) {
    if (next() != line) fail("\"" + std::string(line) + "\" is needed");
}

std::string_view LineScanner::word() {
    look_for_stop();
    if (!std::exchange(first_word_, false)) {
        if (!line_.starts_with(' ')) fail("the line ends too early");
        line_.remove_prefix(1);
    }
    const std::string_view word = line_.substr(0, line_.find(' '));
    line_.remove_prefix(word.size());
    return word;
}

void LineScanner::expect_word(std::string_view expected) {
    if (word() != expected) fail("\"" + std::string(expected) + "\" is needed");
}

std::uint64_t LineScanner::integer() {
    const std::string_view text = word();
    std::uint64_t value = 0;
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool padded = text.size() > 1 && text[0] == '0';
    if (code != std::errc() || end != text.data() + text.size() || padded)
        fail("a whole number is needed");
    return value;
}

template <class Real>
Real LineScanner::number() {
    const std::string_view text = word();
    const auto value = shortest_decimal<Real>(text);
    if (!value) fail("a number in the shortest form is needed");
    return *value;
}

template double LineScanner::number<double>();
template float LineScanner::number<float>();

void LineScanner::expect_point(const Point3& point) {
    for (const double coordinate : {point.x, point.y, point.z})
        if (!same_bits(number<double>(), coordinate))
            fail("another coordinate than in the certificate");
}

void LineScanner::end_line() {
    if (!line_.empty()) fail("the line has more words than it should");
}

void LineScanner::end() {
    if (!at_end()) {
        ++number_;
        fail("the file has more lines than it should");
    }
}

} // namespace terrane::verifier
