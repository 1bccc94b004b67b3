// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Compares output files of the kinds "volumes" and "tetrahedra" (R21). See Kind::compare.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include <terrane/algorithms/verify/detail/inputs.hpp>
#include <terrane/algorithms/verify/detail/kinds.hpp>

namespace terrane::verifier {

/// The name of an output says what it must hold: DIR/model.json, DIR/result.vtp,
/// DIR/blocks/block_N.vtp, DIR/interfaces/interface_N.vtp; parts may be in OBJ.
std::string compare_block_file(std::string_view contents, const Certificate& certificate,
                               const CertifiedOutput& output, std::shared_ptr<const Folder>& kept,
                               OutputVerdict& verdict);

/// Checks that the outputs are all files of one folder with these blocks, each once (R21). There
/// may be no outputs at all. Precondition: the claims of the certificate hold.
void check_folder_files(const Certificate& certificate, Violations& found);

/// All outputs hold all tetrahedra.
std::string compare_tetrahedra_file(std::string_view contents, const Certificate& certificate,
                                    const CertifiedOutput& output,
                                    std::shared_ptr<const Folder>& kept, OutputVerdict& verdict);

} // namespace terrane::verifier
