// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Changes of certificates of any kind, for the targets forge_KIND.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <terrane/algorithms/verify/verify.hpp>

#include "bytes.hpp"

namespace terrane::fuzz {

inline constexpr std::size_t bytes_of_change = 8;
inline constexpr unsigned most_changes = 3;

/// The contents of the output files of a certificate, in their order.
using Contents = std::vector<std::string>;

/// Makes the change that the next bytes stand for, and names it. It may leave the certificate as it
/// is, where it does not apply.
std::string change(Certificate& certificate, Contents& contents, Bytes& bytes);

} // namespace terrane::fuzz
