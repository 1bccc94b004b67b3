// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Reads text files line by line and word by word, for the readers of output.hpp. Lines end with a
// line feed, words are separated by one blank.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/verify/detail/output.hpp>

namespace terrane::verifier {

/// All functions but at_end() throw a Difference if the text goes on otherwise.
class LineScanner {
public:
    explicit LineScanner(std::string_view text) : rest_(text) {}

    [[nodiscard]] bool at_end() const { return rest_.empty(); }
    /// Goes to the next line and returns it.
    std::string_view next();
    /// Goes to the next line, which must be this one.
    void expect(std::string_view line);
    /// Takes the next word of the line, which must be this one.
    void expect_word(std::string_view word);
    std::uint64_t integer();
    /// Takes a float or a double, as the shortest decimal.
    template <class Real>
    Real number();
    /// Takes three numbers, which must be the bits of this point.
    void expect_point(const Point3& point);
    /// Checks that the line has no more words.
    void end_line();
    /// Checks that there are no more lines.
    void end();
    [[noreturn]] void fail(std::string sentence) const;

private:
    std::string_view word();

    std::string_view rest_;  ///< after the current line
    std::string_view line_;  ///< rest of the current line
    std::size_t number_ = 0; ///< of the current line, from 1
    bool first_word_ = true;
};

} // namespace terrane::verifier
