// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/core/guarded.hpp>

#include <catch2/catch.hpp>

namespace {

using namespace terrane;

/// The result of a stage that throws this.
template <class Thrown>
ErrorCode code_of(const Thrown& thrown) {
    const auto work = [&]() -> Result<int> { throw thrown; };
    const Result<int> result = guarded("for the test", "test", work);
    return result.error().code;
}

std::system_error system_error(std::errc code) {
    return std::system_error(std::make_error_code(code));
}

} // namespace

TEST_CASE("guarded: lack of memory and of threads is out_of_memory, a broken promise is internal") {
    CHECK(code_of(std::bad_alloc()) == ErrorCode::out_of_memory);
    CHECK(code_of(std::length_error("vector")) == ErrorCode::out_of_memory);
    CHECK(code_of(system_error(std::errc::resource_unavailable_try_again)) ==
          ErrorCode::out_of_memory);
    CHECK(code_of(std::runtime_error("pthread_create has failed: Resource temporarily "
                                     "unavailable")) == ErrorCode::out_of_memory);
    CHECK(code_of(std::logic_error("broken")) == ErrorCode::internal);
}

TEST_CASE("guarded: what it does not know goes on to the caller") {
    CHECK_THROWS_AS(code_of(std::runtime_error("another")), std::runtime_error);
    CHECK_THROWS_AS(code_of(system_error(std::errc::permission_denied)), std::system_error);
}
