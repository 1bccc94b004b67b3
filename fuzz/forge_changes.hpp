// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Changes of certificates, for the target forge.
#pragma once

#include <cstddef>
#include <string>

#include <terrane/algorithms/verify/verify_certificate.hpp>

#include "bytes.hpp"

namespace terrane::fuzz {

inline constexpr std::size_t bytes_of_change = 8;
inline constexpr unsigned most_changes = 3;

/// Makes the change that the next bytes stand for, and names it. It may leave the certificate as it
/// is, where it does not apply.
std::string change(Certificate& certificate, Bytes& bytes);

} // namespace terrane::fuzz
