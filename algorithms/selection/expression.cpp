// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/selection/expression.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <system_error>
#include <utility>

namespace terrane {
namespace {

using Action = Expression::Action;
using Kind = Expression::Kind;

/// Binary operators by strength, the weakest first.
constexpr std::array<std::pair<char, Action>, 4> binary{{{'|', Action::unite},
                                                         {'^', Action::exclude},
                                                         {'&', Action::intersect},
                                                         {'-', Action::difference}}};

/// The sides of surfaces: whether each is the lower one along an axis.
struct SideFunction {
    std::string_view name;
    Axis axis;
    bool is_low;
};
constexpr std::array<SideFunction, 6> side_functions{{{"below", Axis::z, true},
                                                      {"above", Axis::z, false},
                                                      {"west", Axis::x, true},
                                                      {"east", Axis::x, false},
                                                      {"south", Axis::y, true},
                                                      {"north", Axis::y, false}}};

bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

bool is_of_name(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '.' || static_cast<unsigned char>(c) >= 0x80;
}

/// Reads an expression by recursive descent. After the first flaw it reads no further.
class Parser {
public:
    explicit Parser(std::string_view text) : text_(text) {}

    Result<Expression> operator()() {
        read(0);
        if (!flaw_ && peek() != '\0') expect("an operator: | ^ & -");
        if (flaw_) return *flaw_;
        return std::move(made_);
    }

private:
    /// Nested deeper than this, an expression is refused: the stack has an end.
    static constexpr int most_nested = 1000;

    /// Skips blanks; returns the next character, or 0 at the end.
    char peek() {
        while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
        return at_ < text_.size() ? text_[at_] : '\0';
    }
    bool take(char c) {
        if (peek() != c) return false;
        ++at_;
        return true;
    }
    void fail(std::string sentence, std::size_t at) {
        if (!flaw_)
            flaw_ = Error{ErrorCode::bad_option, std::move(sentence),
                          "expression, column " + std::to_string(at + 1)};
    }
    void expect(std::string_view what) {
        const char c = peek();
        const std::string found = c == '\0' ? "the end" : std::string("'") + c + "'";
        fail("expected " + std::string(what) + ", not " + found, at_);
    }

    /// Reads operators from this strength on.
    void read(std::size_t strength) {
        if (strength == binary.size()) return read_unary();
        read(strength + 1);
        while (!flaw_ && take(binary[strength].first)) {
            read(strength + 1);
            made_.steps.push_back({binary[strength].second});
        }
    }

    void read_unary() {
        if (flaw_) return;
        if (++depth_ > most_nested) return fail("is nested more than 1000 times", at_);
        if (take('~')) {
            read_unary();
            made_.steps.push_back({Action::complement});
        } else if (take('(')) {
            read_rest_of_brackets();
        } else {
            read_name();
        }
        --depth_;
    }

    void read_rest_of_brackets() {
        read(0);
        if (!flaw_ && !take(')')) expect("an operator or ')'");
    }

    void read_name() {
        const bool is_quoted = peek() == '"';
        const std::size_t first = at_;
        std::string name = take_name();
        if (flaw_) return;
        if (!is_quoted && (name == "volume" || name == "age") && (peek() == '<' || peek() == '>'))
            return read_comparison(name == "age" ? Kind::age : Kind::volume);
        if (is_quoted || !take('('))
            return push({std::move(name), is_inside_ ? Kind::inside : Kind::bare});
        if (name == "inside") {
            const bool was_inside = std::exchange(is_inside_, true);
            read_rest_of_brackets();
            is_inside_ = was_inside;
            return;
        }
        const auto side = std::ranges::find(side_functions, name, &SideFunction::name);
        const bool is_side = side != side_functions.end();
        const bool is_block = name == "block" || name == "unit";
        if (!is_side && !is_block && name != "hull")
            return fail("there is no function " + name +
                            "(); there are inside(), hull(), below(), above(), west(), east(), "
                            "south(), north(), block() and unit()",
                        first);
        std::string of = take_name();
        if (flaw_) return;
        const Kind kind = is_side           ? Kind::low_side
                          : name == "block" ? Kind::block
                          : name == "unit"  ? Kind::unit
                                            : Kind::enclosed;
        push({std::move(of), kind, is_side ? side->axis : Axis::z});
        if (is_side && !side->is_low) made_.steps.push_back({Action::complement});
        if (!take(')'))
            expect("')': " + name + "() takes the name of one " + (is_block ? name : "surface"));
    }

    /// Reads what follows "volume" or "age": "< 1e6".
    void read_comparison(Kind kind) {
        Expression::Operand operand{kind == Kind::age ? "age" : "volume", kind};
        operand.is_less = take('<');
        if (!operand.is_less) take('>');
        peek();
        const char* const first = text_.data() + at_;
        const auto read = std::from_chars(first, text_.data() + text_.size(), operand.number);
        if (read.ec != std::errc() || !std::isfinite(operand.number)) return expect("a number");
        at_ += static_cast<std::size_t>(read.ptr - first);
        push(std::move(operand));
    }

    std::string take_name() {
        const bool is_quoted = peek() == '"';
        const std::size_t first = at_;
        std::string name;
        if (is_quoted) {
            const std::size_t end = text_.find('"', first + 1);
            if (end == std::string_view::npos) {
                fail("this quote has no end", first);
                return name;
            }
            name = text_.substr(first + 1, end - first - 1);
            at_ = end + 1;
            if (name.empty()) fail("a name may not be empty", first);
            return name;
        }
        while (at_ < text_.size() && is_of_name(text_[at_])) ++at_;
        name = text_.substr(first, at_ - first);
        if (name.empty()) expect("a name, '(' or '~'");
        return name;
    }

    void push(Expression::Operand operand) {
        const auto kind = [](const Expression::Operand& o) {
            return o.kind == Kind::bare ? Kind::inside : o.kind;
        };
        const auto known = std::ranges::find_if(made_.operands, [&](const auto& o) {
            return o.name == operand.name && kind(o) == kind(operand) && o.axis == operand.axis &&
                   o.is_less == operand.is_less && o.number == operand.number;
        });
        made_.steps.push_back(
            {Action::operand, static_cast<std::uint32_t>(known - made_.operands.begin())});
        if (known == made_.operands.end())
            made_.operands.push_back(std::move(operand));
        else if (known->kind == Kind::bare)
            known->kind = operand.kind;
    }

    std::string_view text_;
    std::size_t at_ = 0;
    int depth_ = 0;
    bool is_inside_ = false; ///< of inside()
    std::optional<Error> flaw_;
    Expression made_;
};

bool combined(Action action, bool a, bool b) {
    switch (action) {
    case Action::difference:
        return a && !b;
    case Action::intersect:
        return a && b;
    case Action::exclude:
        return a != b;
    default:
        return a || b;
    }
}

} // namespace

bool Expression::value(const std::function<bool(std::uint32_t)>& is_inside) const {
    std::vector<bool> stack;
    for (const Step& step : steps) {
        if (step.action == Action::operand) {
            stack.push_back(is_inside(step.operand));
        } else if (step.action == Action::complement) {
            stack.back() = !stack.back();
        } else {
            const bool b = stack.back();
            stack.pop_back();
            stack.back() = combined(step.action, stack.back(), b);
        }
    }
    return stack.back();
}

Result<Expression> parse_expression(std::string_view text) {
    return Parser(text)();
}

} // namespace terrane
