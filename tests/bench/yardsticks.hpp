// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The operations of CGAL 5.5.1 (Debian) on the same inputs, converted before the clock starts.
#pragma once

#include <cstddef>
#include <memory>

#include "models.hpp"

namespace bench {

/// CGAL::box_intersection_d on given boxes, first surface against second. Returns the number of
/// pairs.
class BoxIntersection {
public:
    explicit BoxIntersection(const Model& m);
    ~BoxIntersection();
    void prepare(); ///< copies the boxes, which a call reorders
    std::size_t operator()();

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// PMP::corefine of two surfaces, EPICK; it assumes that neither intersects itself.
class Corefine {
public:
    explicit Corefine(const Model& m);
    ~Corefine();
    void prepare(); ///< makes fresh copies of the surfaces
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
