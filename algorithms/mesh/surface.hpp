// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <terrane/kernel/point.hpp>

namespace terrane {

/// The corners of a triangle, as indices into the array of vertices that accompanies it.
using Triangle = std::array<std::uint32_t, 3>;

/// The geological role of a surface. It does not influence the geometry of an arrangement.
enum class Role : std::uint8_t { unknown, horizon, fault, boundary };

/// The direction in which the heights of a file are counted.
enum class VerticalAxis : std::uint8_t {
    unstated, ///< the file does not say, nor did the user; taken for up
    up,       ///< heights
    down,     ///< depths; they were turned into heights when the file was read
};

/// The units and the system of coordinates that the file of a surface states. No geometry depends
/// on them.
struct CoordinateFrame {
    std::string horizontal_unit{}; ///< of x and y: "m", "ft"; empty: not stated
    std::string vertical_unit{};   ///< of z; empty: not stated
    std::string system{};          ///< coordinate system; empty: not stated
    VerticalAxis vertical_axis = VerticalAxis::unstated; ///< of z
    bool column_of_depths = false; ///< z is a column called depth that was not turned over
};

/// Faces of a file with more than three corners whose triangles may be others than were meant: they cross
/// themselves, or are not flat. No geometry depends on them.
struct FlawedFaces {
    std::size_t crossing = 0; ///< number of those that cross or touch themselves
    std::size_t bent = 0;     ///< number of those with more than four corners that are not flat
    Point3 first{};           ///< first corner of the first one; unit of the file
};

/// The types of numbers that files distinguish.
enum class NumberType : std::uint8_t {
    float64,
    float32,
    int8,
    uint8,
    int16,
    uint16,
    int32,
    uint32,
    int64,
    uint64
};

/// Returns the name of a type: "float64", "int8", ...
std::string_view name_of(NumberType type);

/// Numbers of a floating-point type, or of an integer type. Where memory ends during a copy, std::variant of libstdc++ 12
/// would destroy what is not there yet: here a vector is copied first, and moved.
struct ValueNumbers : std::variant<std::vector<double>, std::vector<std::int64_t>> {
    using variant::variant;
    ValueNumbers() = default;
    ValueNumbers(const ValueNumbers& other) : variant(copy_of(other)) {}
    ValueNumbers(ValueNumbers&&) noexcept = default;
    ValueNumbers& operator=(const ValueNumbers& other) { return *this = ValueNumbers(other); }
    ValueNumbers& operator=(ValueNumbers&&) noexcept = default;
    ~ValueNumbers() = default;

private:
    static variant copy_of(const variant& other) {
        if (other.index() == 0) return {std::vector(std::get<0>(other))};
        return {std::vector(std::get<1>(other))};
    }
};

/// A named array with a value on each vertex, or on each triangle, of a surface or mesh.
struct ValueArray {
    std::string name;                      ///< as in the file
    bool on_triangles = false;             ///< otherwise on vertices
    std::uint32_t components = 1;          ///< numbers per value, > 0: 3 for a vector
    NumberType type = NumberType::float64; ///< the type in the file
    /// All components of the first value, then of the next. Floating-point types are doubles, others
    /// integers of 64 bits: of uint64 these have the same bits.
    ValueNumbers numbers{};
    std::string unit{};               ///< as in the file; empty: not stated
    std::optional<double> no_data{};  ///< the number that stands for no value, as NaN always does
    std::vector<std::string> texts{}; ///< if there are any, the numbers are indices of these

    /// Returns how many values there are.
    [[nodiscard]] std::size_t size() const;
    [[nodiscard]] bool is_integer() const { return numbers.index() == 1; }

    friend bool operator==(const ValueArray&, const ValueArray&) = default;
};

/// The arrays of one surface of a mesh: on the vertices that its triangles use, ascending, and on its triangles.
using SurfaceValues = std::vector<ValueArray>;

/// A triangulated surface as it is read. It may be open, cross itself, and have duplicate or
/// degenerate triangles; only its coordinates must be finite.
struct Surface {
    std::string name;                ///< from the file; need not be unique
    Role role = Role::unknown;       ///< its geological role
    std::vector<Point3> vertices;    ///< order and unit of the file; finite
    std::vector<Triangle> triangles; ///< order of the file; indices < vertices.size()
    CoordinateFrame frame{};         ///< what the file states about the coordinates
    FlawedFaces flawed_faces{};      ///< those of the file
    std::vector<ValueArray>
        arrays{}; ///< values on vertices and triangles, as in the file; a stage that
                  ///< changes the surface leaves them behind
    std::vector<std::string> values{}; ///< names of further values in the file, which were not read
};

} // namespace terrane
