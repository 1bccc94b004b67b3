// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Shows which assertions are on at the level with which it was compiled, its one argument:
// assertions of this level and of those below fire; those above are not even evaluated.
#include <terrane/kernel/assertion.hpp>

#include <iostream>
#include <stdexcept>
#include <string>

namespace {

int evaluated = 0;

bool broken() {
    ++evaluated;
    return false;
}

template <class Assertion>
bool fires(const Assertion& assertion) {
    try {
        assertion();
    } catch (const std::logic_error& error) {
        const std::string text = error.what();
        return text.find("broken()") != std::string::npos &&
               text.find("assertion_levels.cpp:") != std::string::npos;
    }
    return false;
}

} // namespace

int main(int argc, char** argv) {
    const std::string level = argc == 2 ? argv[1] : "";
    const int expected = level == "always" ? 1 : level == "debug" ? 2 : level == "paranoid" ? 3 : 0;
    const bool always = fires([] { TERRANE_ASSERT(broken()); });
    const bool debug = fires([] { TERRANE_ASSERT_DEBUG(broken()); });
    const bool paranoid = fires([] { TERRANE_ASSERT_PARANOID(broken()); });
    TERRANE_ASSERT(evaluated > 0); // a true condition does not fire
    const bool good = expected > 0 && always && debug == (expected >= 2) &&
                      paranoid == (expected >= 3) && evaluated == expected;
    std::cout << level << ": always " << always << ", debug " << debug << ", paranoid " << paranoid
              << ", evaluated " << evaluated << '\n';
    return good ? 0 : 1;
}
