// SPDX-License-Identifier: LGPL-3.0-or-later
//
// scripts/mutants.py includes this before each source. It writes `a < b` as `a <=LESS(17)>= b`, which parses alike,
// and TERRANE_MUTANT chooses at run time which of these comparisons is another one. TERRANE_MUTANTS_REACHED is a
// file that gets a byte per place: 1 if it was reached.
#pragma once
#include <cstdio>
#include <cstdlib>
#include <type_traits>
#include <utility>

namespace terrane::mutants {

inline constexpr unsigned most_places = 1 << 16;

/// The place and the variant that are switched on; no place is 0.
struct Chosen {
    unsigned place = 0, variant = 0;
    Chosen() {
        if (const char* text = std::getenv("TERRANE_MUTANT"))
            std::sscanf(text, "%u.%u", &place, &variant);
    }
};
inline const Chosen chosen;

struct Reached {
    char places[most_places] = {};
    ~Reached() {
        const char* name = std::getenv("TERRANE_MUTANTS_REACHED");
        std::FILE* file = name ? std::fopen(name, "wb") : nullptr;
        if (!file) return;
        std::fwrite(places, 1, most_places, file);
        std::fclose(file);
    }
};
inline Reached reached;

/// Returns the variant that is switched on at a place, or 0.
constexpr unsigned variant_at(unsigned place) {
    if (std::is_constant_evaluated()) return 0;
    reached.places[place] = 1;
    return chosen.place == place ? chosen.variant : 0;
}

/// A comparison: variant 1 negates it, 2 moves its boundary or ends a loop one step earlier.
template <int kind>
struct Comparison {
    unsigned place;
};
template <int kind, class A>
struct Left {
    const A& a;
    unsigned place;
};

template <class R>
constexpr R negated_if(bool negate, R result) {
    return negate ? static_cast<R>(!result) : result;
}

template <int kind, class A>
constexpr Left<kind, A> operator<=(const A& a, Comparison<kind> c) {
    return {a, c.place};
}
template <int kind, class A>
constexpr Left<kind, A> operator==(const A& a, Comparison<kind> c) {
    return {a, c.place};
}

template <class A, class B>
constexpr auto operator>=(Left<0, A> l, const B& b) { // a < b
    const unsigned variant = variant_at(l.place);
    if (variant == 2) return negated_if(true, b < l.a);
    return negated_if(variant == 1, l.a < b);
}
template <class A, class B>
constexpr auto operator>=(Left<1, A> l, const B& b) { // a <= b
    const unsigned variant = variant_at(l.place);
    if (variant == 2) return negated_if(true, b <= l.a);
    return negated_if(variant == 1, l.a <= b);
}
template <class A, class B>
constexpr auto operator>=(Left<2, A> l, const B& b) { // a > b
    const unsigned variant = variant_at(l.place);
    if (variant == 2) return negated_if(true, b > l.a);
    return negated_if(variant == 1, l.a > b);
}
template <class A, class B>
constexpr auto operator>=(Left<3, A> l, const B& b) { // a >= b
    const unsigned variant = variant_at(l.place);
    if (variant == 2) return negated_if(true, b >= l.a);
    return negated_if(variant == 1, l.a >= b);
}
template <class A, class B>
constexpr auto operator==(Left<4, A> l, const B& b) { // a == b
    return negated_if(variant_at(l.place) == 1, l.a == b);
}
template <class A, class B>
constexpr auto operator==(Left<5, A> l, const B& b) { // a != b
    return negated_if(variant_at(l.place) == 1, l.a != b);
}
template <class A, class B>
constexpr auto operator>=(Left<6, A> l, const B& b) { // a < b in the header of a loop
    const unsigned variant = variant_at(l.place);
    if constexpr (std::is_integral_v<A>)
        if (variant == 2) return decltype(l.a < b)(l.a < b && l.a + 1 != static_cast<A>(b));
    return negated_if(variant == 1, l.a < b);
}

/// `a &&And(17)| b`: variant 1 takes b for true; `a ||Or(17)| b`: it takes b for false.
struct And {
    unsigned place;
};
struct Or {
    unsigned place;
};
template <class B>
constexpr bool operator|(And a, const B& b) {
    return variant_at(a.place) == 1 || static_cast<bool>(b);
}
template <class B>
constexpr bool operator|(Or o, const B& b) {
    return variant_at(o.place) != 1 && static_cast<bool>(b);
}

/// `if (Condition(17)(a))`: variant 1 negates it.
struct Condition {
    unsigned place;
    template <class A>
    constexpr bool operator()(const A& a) const {
        return static_cast<bool>(a) != (variant_at(place) == 1);
    }
};

/// `for (First f{17}; x : all) if (f.skips()) {} else ...`: variant 1 skips the first step.
struct First {
    unsigned place;
    bool is_first = true;
    constexpr bool skips() { return std::exchange(is_first, false) && variant_at(place) == 1; }
};

} // namespace terrane::mutants
