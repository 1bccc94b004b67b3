// SPDX-License-Identifier: LGPL-3.0-or-later
//
// What Debian's CGAL 5.5.1 does with the same inputs. Inputs are converted before the clock starts.
#pragma once

#include <cstddef>
#include <memory>

#include "models.hpp"

namespace bench {

/// CGAL::box_intersection_d on given boxes, first surface against second. The number of pairs.
class BoxIntersection {
public:
    explicit BoxIntersection(const Model& m);
    ~BoxIntersection();
    void prepare(); ///< it reorders what it is given
    std::size_t operator()();

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// PMP::corefine of two surfaces, EPICK; trusts each to be free of self-intersections.
class Corefine {
public:
    explicit Corefine(const Model& m);
    ~Corefine();
    void prepare(); ///< fresh copies of the surfaces
    std::size_t operator()();

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// PMP::experimental::autorefine of all surfaces as one mesh, EPICK.
class Autorefine {
public:
    explicit Autorefine(const Model& m);
    ~Autorefine();
    void prepare();
    std::size_t operator()();

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace bench
