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
    /// An empty mesh.
    SharedMesh() : mesh_(std::make_shared<const Mesh>()) {}
    /// Takes a mesh, which nobody can change from then on.
    SharedMesh(Mesh mesh) :
        // NOLINT: implicit on purpose
        mesh_(std::make_shared<const Mesh>(std::move(mesh))) {}
    /// Shares the mesh. There is no move, which would leave a null pointer.
    SharedMesh(const SharedMesh&) = default;
    /// Shares the mesh.
    SharedMesh& operator=(const SharedMesh&) = default;
    ~SharedMesh() = default;

    /// The mesh.
    [[nodiscard]] const Mesh& operator*() const { return *mesh_; }
    /// A member of the mesh.
    [[nodiscard]] const Mesh* operator->() const { return mesh_.get(); }
    /// The mesh.
    operator const Mesh&() const { return *mesh_; } // NOLINT: implicit on purpose

private:
    std::shared_ptr<const Mesh> mesh_;
};

} // namespace terrane
