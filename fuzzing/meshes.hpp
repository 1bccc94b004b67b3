// SPDX-License-Identifier: MIT
//
// Meshes from the bytes of a fuzzer. Points are on small integer lattices, so that degeneracy is common, some of them
// off by an ulp; then they are turned, scaled and shifted together. The same bytes give the same mesh in every version.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace terrane::fuzzing {

/// A point with finite coordinates.
struct Point {
    double x = 0, y = 0, z = 0;

    friend bool operator==(const Point&, const Point&) = default;
};

/// The corners of a triangle, as indices into the points of its part.
using Triangle = std::array<std::uint32_t, 3>;

/// An indexed set of triangles: a surface, or an operand. It may be open, cross itself and have any degeneracy.
struct Part {
    std::vector<Point> points;
    std::vector<Triangle> triangles; ///< indices < points.size()

    friend bool operator==(const Part&, const Part&) = default;
};

using Soup = std::vector<Part>;

/// Returns the number of triangles of all parts.
std::size_t triangle_count(const Soup& soup);

/// Returns an OBJ file from which the same points and triangles are read; its groups are the parts: a, b, ...
std::string obj_text(const Soup& soup);

/// Reads small numbers from the bytes of a fuzzer, from the front and one byte each, so that a changed byte changes one
/// number; after the last byte they are zero. (FuzzedDataProvider of clang takes bytes from the back, and other
/// compilers do not have it.)
class Bytes {
public:
    Bytes(const std::uint8_t* bytes, std::size_t size) : next_(bytes), end_(bytes + size) {}

    [[nodiscard]] bool empty() const { return next_ == end_; }
    unsigned byte() { return empty() ? 0 : *next_++; }
    bool flag() { return (byte() & 1) != 0; }
    /// Returns a number in [0, count); count <= 256.
    unsigned below(unsigned count) { return byte() % count; }
    /// Returns a number in [low, high], which has at most 256 numbers.
    int between(int low, int high) {
        return low + static_cast<int>(below(static_cast<unsigned>(high - low + 1)));
    }
    /// Returns any double, from eight bytes, including NaN and infinities.
    double any_double();

private:
    const std::uint8_t* next_;
    const std::uint8_t* end_;
};

/// The transformation of all points of an input: steps of 1, 0.1 or 1/3; turned by 0.6 and 0.8; shifted to UTM
/// coordinates, or farther; times a power of two. Its steps may round, so that coplanar points become nearly coplanar.
class Frame {
public:
    explicit Frame(Bytes& bytes);
    [[nodiscard]] Point operator()(Point p) const;
    /// Tells whether lattice points stay in their planes: there is no rotation, no fraction and no shift.
    [[nodiscard]] bool exact() const { return step_ == 1 && !turned_ && shift_ == Point{}; }
    /// The power of two.
    [[nodiscard]] int exponent() const { return exponent_; }

private:
    double step_ = 1;
    bool turned_ = false;
    Point shift_;
    int exponent_ = 0;
};

/// Makes points, which are repeated more often than by chance.
class Points {
public:
    explicit Points(Bytes& bytes) : frame_(bytes), range_(1 + static_cast<int>(bytes.below(4))) {}

    /// Returns an earlier point, or a new one.
    Point next(Bytes& bytes);
    /// Returns a transformed point of the lattice.
    [[nodiscard]] Point placed(const Point& p) const { return frame_(p); }
    [[nodiscard]] int range() const { return range_; }

private:
    Frame frame_;
    int range_;
    std::vector<Point> earlier_;
};

/// Appends a triangle; this and the following functions append points of their own.
void add_triangle(Part& part, const std::array<Point, 3>& corners);
/// Appends triangles with a common edge.
void add_fan(Part& part, Points& points, Bytes& bytes);
/// Appends a height field of n x m squares along any axis, with holes if requested.
void add_sheet(Part& part, const Points& points, Bytes& bytes, bool holes);
/// Appends a closed tetrahedron, oriented outward if its corners are in general position.
void add_tetrahedron(Part& part, const std::array<Point, 4>& corners);
/// Appends two tetrahedra with a common face, which is left out: corners 0, 1, 2 are its own.
void add_double_pyramid(Part& part, const std::array<Point, 5>& corners);
void add_box(Part& part, const Points& points, Bytes& bytes);

/// Returns one to four parts with at most `most` triangles in all: single triangles, fans, sheets, closed pieces, and
/// copies of earlier pieces.
Soup soup(Bytes& bytes, std::size_t most);

/// Returns one part with at most `most` triangles, very many of them in one plane, at one line or at one point.
Soup crowd(Bytes& bytes, std::size_t most);

/// Returns one or two parts with at most `most` triangles: with integer corners nearest to one plane, so that no four
/// are quite coplanar, and needles along few lines. Coordinates are integers below 2^21 times one power of two, so that
/// determinants of three differences are below 2^69: integers of 128 bits judge them.
Soup near_plane(Bytes& bytes, std::size_t most);

/// Two closed solids, each made of cubes of side 2: with holes, cavities, solids in cavities, and cubes that touch at
/// edges and corners. They are in any contact at integers: apart, touching, overlapping, equal; then they are sheared,
/// which keeps volumes, and transformed by one frame.
struct Solids {
    Soup operands; ///< two parts, oriented outward; one may be empty
    /// The volumes of the two operands, their union, intersection, difference and symmetric difference before the frame.
    std::array<double, 6> volumes{};
    bool exact =
        false; ///< whether the frame only multiplies by 2^exponent, and volumes by 8^exponent
    int exponent = 0;
};

/// Returns solids with at most `most` triangles, or single cubes.
Solids solids(Bytes& bytes, std::size_t most);

/// Returns a mesh of one of the four kinds above, which the first byte chooses.
Soup any_mesh(Bytes& bytes, std::size_t most);

/// Makes a mesh of bytes: a function of this header, or one of the target's own.
using Generator = std::function<Soup(Bytes&)>;

/// Returns the mesh that bytes stand for: of a literal mesh itself, else what the generator makes of them. Literal
/// meshes are the form for what a mutator or a minimiser made, which no bytes of a generator stand for. They begin with
/// "mesh", by which a generator's bytes begin only by chance; so these keep their meaning. Then follow, big-endian, the
/// number of parts (1 byte) and per part the number of points (2 bytes), their coordinates (doubles), the number of
/// triangles (2 bytes) and their corners (2 bytes each). Any bytes are a mesh: an index is taken modulo the number of
/// points, a number that is not finite is 0, and what is cut off is not there.
Soup mesh_of(const std::uint8_t* data, std::size_t size, const Generator& generator);

/// Tells whether bytes are a literal mesh.
bool is_literal(const std::uint8_t* data, std::size_t size);

/// Returns the bytes of a literal mesh. It leaves out what 1 and 2 bytes cannot count.
std::vector<std::uint8_t> literal(const Soup& soup);

} // namespace terrane::fuzzing
