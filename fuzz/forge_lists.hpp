// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Changes of lists, of blocks and tetrahedra, and of output files in certificates.
#pragma once

#include <span>
#include <string>

#include "forge_changes.hpp"
#include "forge_triangles.hpp"

namespace terrane::fuzz {

struct Change {
    const char* name;
    void (*make)(Certificate&, const Arguments&);
};

/// Makes a number small, one more, one less, another side, or the mark of none.
void change_number(std::uint32_t& number, const Arguments& arguments);

/// Returns the changes that only certificates of a kind have.
std::span<const Change> changes_of(CertificateKind kind);

std::span<const Change> changes_of_layers();
std::span<const Change> changes_of_cuts();
std::span<const Change> changes_of_seals();

/// Changes one of the lists of a certificate, together with those that are parallel to it or not:
/// drops, repeats or exchanges elements, changes a number, empties it.
std::string change_list(Certificate& certificate, unsigned which, const Arguments& arguments);

/// Returns the surface of each input triangle of a certificate with "cut"; those of the boundary come
/// last.
Numbers surfaces_of_inputs(const Certificate& certificate);

/// Removes from the doubles what is dropped now and was not before, where they are the exact
/// triangles that were kept. Intersection edges go with it as far as one surface is left there.
void follow_dropped(Certificate& certificate, const Numbers& before);

/// Numbers the regions of the doubles of a certificate with "cut" as their intersection edges divide
/// the surfaces.
void renumber_regions(Certificate& certificate);

/// Changes what the certificate says of its output files, or a byte of one.
std::string change_files(Certificate& certificate, Contents& contents, const Arguments& arguments);

} // namespace terrane::fuzz
