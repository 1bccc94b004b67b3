// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <memory>
#include <utility>

#include <terrane/algorithms/mesh/mesh.hpp>

namespace terrane {

/// A mesh that nobody can change any more; copies share it. It is used like a pointer, and passed
/// where a const Mesh& is wanted. It is never null.
class SharedMesh {
public:
    SharedMesh() : mesh_(std::make_shared<const Mesh>()) {}
    SharedMesh(Mesh mesh) :
        // NOLINT: implicit on purpose
        mesh_(std::make_shared<const Mesh>(std::move(mesh))) {}
    SharedMesh(const SharedMesh&) = default; // no move: it would leave a null pointer
    SharedMesh& operator=(const SharedMesh&) = default;
    ~SharedMesh() = default;

    [[nodiscard]] const Mesh& operator*() const { return *mesh_; }
    [[nodiscard]] const Mesh* operator->() const { return mesh_.get(); }
    operator const Mesh&() const { return *mesh_; } // NOLINT: implicit on purpose

private:
    std::shared_ptr<const Mesh> mesh_;
};

} // namespace terrane
