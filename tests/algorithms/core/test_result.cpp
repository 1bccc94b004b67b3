// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Result has the functions of std::expected, with the same meaning.
#include <terrane/algorithms/core/result.hpp>

#include <catch2/catch.hpp>

#include <memory>
#include <string>
#include <type_traits>
#include <vector>

namespace {

using namespace terrane;

using Strings = std::vector<std::string>;

Result<int> number(const std::string& text) {
    if (text.empty()) return Error{ErrorCode::bad_number, "no digits", "line 1"};
    return std::stoi(text);
}

Result<int> half(int n) {
    if (n % 2 != 0) return Error{ErrorCode::unsupported, "odd", ""};
    return n / 2;
}

Status require_even(int n) {
    if (n % 2 != 0) return Error{ErrorCode::unsupported, "odd", ""};
    return Done{};
}

} // namespace

TEST_CASE("result: a value is reached by star, arrow and value, and can be changed") {
    Result<Strings> made = Strings{"top"};
    REQUIRE(made);
    CHECK(made.has_value());
    CHECK(made->size() == 1);
    made->push_back("salt");
    (*made)[0] = "base";
    CHECK(*made == Strings{"base", "salt"});
    const Result<Strings>& seen = made;
    CHECK(&*seen == &made.value());
    CHECK(seen->front() == "base");
}

TEST_CASE("result: an error is kept as it is") {
    const Result<int> none = number("");
    REQUIRE_FALSE(none);
    CHECK_FALSE(none.has_value());
    CHECK(none.error().code == ErrorCode::bad_number);
    CHECK(none.error().message() == "line 1: no digits");
}

TEST_CASE("result: value_or gives the value, or the other") {
    CHECK(number("7").value_or(3) == 7);
    CHECK(number("").value_or(3) == 3);
    const Result<std::string> text = std::string("top");
    CHECK(text.value_or("none") == "top");
    CHECK(Result<std::string>(Error{}).value_or("none") == "none");
}

TEST_CASE("result: and_then goes on with a value and stops at the first error") {
    CHECK(number("8").and_then(half).and_then(half).value() == 2);
    CHECK(number("6").and_then(half).and_then(half).error().sentence == "odd");
    CHECK(number("").and_then(half).error().place == "line 1");
    bool called = false;
    const auto called_after = number("").and_then([&](int n) {
        called = true;
        return half(n);
    });
    CHECK_FALSE(called_after);
    CHECK_FALSE(called);
}

TEST_CASE("result: and_then takes a status as well, and a status goes on without an argument") {
    CHECK(number("8").and_then(require_even));
    CHECK_FALSE(number("7").and_then(require_even));
    const Result<int> after = number("8").and_then(require_even).and_then([] { return half(4); });
    CHECK(after.value() == 2);
    const Status failed = Error{ErrorCode::write_failed, "disk full", ""};
    CHECK(failed.and_then([] { return half(4); }).error().code == ErrorCode::write_failed);
    CHECK(failed.transform([] { return 1; }).value_or(0) == 0);
}

TEST_CASE("result: or_else replaces an error and leaves a value") {
    const auto zero = [](const Error& e) -> Result<int> {
        if (e.code == ErrorCode::bad_number) return 0;
        return e;
    };
    CHECK(number("").or_else(zero).value() == 0);
    CHECK(number("5").or_else(zero).value() == 5);
    CHECK(number("5").and_then(half).or_else(zero).error().sentence == "odd");
    const Result<int> kept = number("5");
    CHECK(kept.or_else(zero).value() == 5);
}

TEST_CASE("result: transform changes the value and keeps the error") {
    const auto text = number("12").transform([](int n) { return std::to_string(n + 1); });
    static_assert(std::is_same_v<decltype(text), const Result<std::string>>);
    CHECK(*text == "13");
    CHECK(number("").transform([](int n) { return n + 1; }).error().sentence == "no digits");
    int seen = 0;
    const auto done = number("4").transform([&](int n) { seen = n; });
    static_assert(std::is_same_v<decltype(done), const Status>);
    CHECK(done);
    CHECK(seen == 4);
}

TEST_CASE("result: rvalues are moved from, never copied") {
    using Owner = std::unique_ptr<int>;
    const auto owner = [] { return Result<Owner>(std::make_unique<int>(3)); };
    CHECK(**owner() == 3);
    CHECK(*owner().value() == 3);
    CHECK(*owner().value_or(nullptr) == 3);
    CHECK(*owner().or_else([](Error e) -> Result<Owner> { return e; }).value() == 3);
    CHECK(owner().transform([](Owner o) { return *o; }).value() == 3);
    CHECK(*owner().and_then([](Owner o) -> Result<Owner> { return o; }).value() == 3);
    Result<Strings> many = Strings(3, "a name too long for the string's own room");
    const std::string* first = many->data();
    const Strings taken = *std::move(many);
    CHECK(taken.data() == first);
    Result<int> failed = Error{ErrorCode::internal, "a sentence too long for its own room", ""};
    const char* sentence = failed.error().sentence.data();
    const Error error = std::move(failed).error();
    CHECK(error.sentence.data() == sentence);
}

#ifdef NDEBUG // other builds end in an assertion
TEST_CASE("result: value and error throw where assertions are off and the other one is held") {
    CHECK_THROWS_AS(number("").value(), std::bad_variant_access);
    CHECK_THROWS_AS(number("1").error(), std::bad_variant_access);
}
#endif
