// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Writes certificates of any kind: JSON, and the keys that all kinds have.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/io/certificate.hpp>
#include <terrane/io/text/text.hpp>

namespace terrane::detail {

/// Writes JSON piece by piece; a tree of values would take ten times the memory.
class CertificateWriter {
public:
    explicit CertificateWriter(std::string& out) : out_(out) {}

    void quote(std::string_view text) {
        using Handler = nlohmann::json::error_handler_t;
        out_ += nlohmann::json(text).dump(-1, ' ', false, Handler::replace);
    }
    void raw(std::string_view text) { out_ += text; }
    void number(std::uint64_t n) { append_number(out_, n); }
    /// Writes a double as a string.
    void quote(double value) {
        out_ += '"';
        append_number(out_, value);
        out_ += '"';
    }

    /// Writes "[a,b,c]", each item by write(item).
    template <class Items, class Write>
    void array(const Items& items, const Write& write, std::string_view between = ",") {
        out_ += '[';
        bool first = true;
        for (const auto& item : items) {
            if (!std::exchange(first, false)) out_ += between;
            write(item);
        }
        out_ += ']';
    }
    template <class Numbers>
    void numbers(const Numbers& items) {
        array(items, [this](std::uint32_t n) { number(n); });
    }
    /// Writes an array of arrays, each on a line of its own.
    template <class Items>
    void arrays(const Items& items) {
        array(
            items, [&](const auto& list) { numbers(list); }, ",\n");
    }
    void lists(const IndexLists<std::uint32_t>& lists) {
        out_ += '[';
        for (std::size_t i = 0; i < lists.size(); ++i) {
            if (i > 0) out_ += ",\n";
            numbers(lists[i]);
        }
        out_ += ']';
    }

private:
    std::string& out_;
};

/// The beginning of all kinds of certificates.
struct CertificateHead {
    std::span<const InputRecord> files;    ///< in the order in which they were read
    std::span<const Surface> surfaces;     ///< of all files, in order
    std::span<const OutputRecord> outputs; ///< the files that hold the result
};

/// Writes the keys "format" to "outputs" and leaves the object open.
void write_head(CertificateWriter& out, std::string_view kind, const CertificateHead& head);

/// Does the same for a certificate of an arrangement, or of one of which a part was left out.
void write_head(CertificateWriter& out, std::string_view kind, const Certified& certified);

/// Writes the keys "exact", "rounded" and "digest" after other keys, and those of
/// Certified::cut.
void write_arrangement(CertificateWriter& out, const Certified& certified, const Run& run);

/// Writes points as lists of three numbers in quotes.
void write_points(CertificateWriter& out, std::span<const Point3> points);

} // namespace terrane::detail
