// SPDX-License-Identifier: LGPL-3.0-or-later
//
// How good a tetrahedron is: the least sine of its dihedral angles, where that of an obtuse angle
// counts less, and, if asked for, its mean ratio.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include <terrane/algorithms/mesh/mesh.hpp>

namespace terrane::optimisation::detail {

/// Tells how the mean ratio limits the quality: its square is at most that of `least` plus that of
/// constants.shape_share times the mean ratio to the power of 3/2. So it never makes an angle count
/// less than `least`, and a larger mean ratio is always better.
struct Measure {
    double least = HUGE_VAL; ///< infinite: the mean ratio does not limit it
};

/// Returns the largest quality that a tetrahedron of this mean ratio can have.
double quality_of_mean_ratio(double ratio, const Measure& measure);

/// A tetrahedron's quality in floating point.
struct Quality {
    double value = 0; ///< least sine of the six dihedral angles, that of an obtuse angle times
                      ///< constants.obtuse_share, or what else counts if that is less; negative for
                      ///< one that is inverted
    double sine = 0;  ///< least sine alone
    bool is_trusted = false; ///< whether the errors of both are below a fifth of the least gain
};

/// Measures a tetrahedron. Angles alone do not tell a needle with good angles from a good tetrahedron.
/// Sources: Freitag and Ollivier-Gooch (1997) and Klingner and Shewchuk (2007) define the biased
/// minimum sine, Liu and Joe (1994) the mean ratio.
Quality quality_of(const Point3& a, const Point3& b, const Point3& c, const Point3& d,
                   const Measure& measure);

using FaceCorners = std::array<Point3, 3>;

/// The faces around a point that is to be placed. They see it on their positive side.
class FacesAround {
public:
    explicit FacesAround(const Measure& measure) : measure_(measure) {}

    /// Adds a face. The tetrahedron at one that does not count is good if its volume is positive.
    void add(const Point3& a, const Point3& b, const Point3& c, bool counts = true);

    /// Returns the least quality of the tetrahedra between the faces and p if it is above `enough`,
    /// which is not negative; none otherwise. A face that was too bad comes first the next time, as
    /// it is likely to be so again.
    [[nodiscard]] std::optional<double> above(const Point3& p, double enough);
    /// Returns the least quality of the tetrahedra between the faces and p; 0 at least.
    [[nodiscard]] double least(const Point3& p);
    /// Returns how many of these are worse than that.
    [[nodiscard]] std::size_t count_below(const Point3& p, double quality) const;
    /// Returns the distance from p to the nearest corner elsewhere; infinite if there is none.
    [[nodiscard]] double nearest(const Point3& p) const;

    /// Returns the direction from the nearest corner elsewhere to p, of the length 1; 0 if there is none.
    [[nodiscard]] Point3 away_from_nearest(const Point3& p) const;
    /// Returns the distance from p to the farthest corner.
    [[nodiscard]] double farthest(const Point3& p) const;

    [[nodiscard]] std::size_t size() const { return faces_.size(); }
    /// Returns how many tetrahedra were measured: the same for any number of threads.
    [[nodiscard]] std::size_t effort() const { return effort_; }

private:
    /// A face, and what does not depend on the point.
    struct Face {
        Point3 a, b, c, ab, ac, normal; ///< of the length of twice its area
        double square_ab = 0, square_ac = 0, square_bc = 0, square_area = 0;
        bool counts = true;
    };

    [[nodiscard]] double square_quality(const Face& face, const Point3& p) const;

    Measure measure_;
    std::vector<Face> faces_;
    std::size_t effort_ = 0;
};

} // namespace terrane::optimisation::detail
