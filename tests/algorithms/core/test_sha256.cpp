// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/core/sha256.hpp>

#include <catch2/catch.hpp>

namespace {

using namespace terrane;

} // namespace

TEST_CASE("sha256: the examples of FIPS 180") {
    CHECK(hexadecimal(sha256("abc")) ==
          "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    CHECK(hexadecimal(sha256("")) ==
          "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}
