// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/text/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include <nlohmann/json.hpp>

namespace terrane::detail {

Json::Json(const Json&) = default;
Json::Json(Json&&) noexcept = default;
Json& Json::operator=(const Json&) = default;
Json& Json::operator=(Json&&) noexcept = default;
Json::~Json() = default;

Json::Json(std::initializer_list<JsonItem> items) {
    if (!std::all_of(items.begin(), items.end(), [](const auto& i) { return i.is_member(); })) {
        *this = array(items);
        return;
    }
    value_.emplace<Object>();
    for (const JsonItem& item : items) {
        Json pair = item.take();
        const auto own = pair.own_entries();
        add_member(std::get<std::string>(std::move(own[0].value_)), std::move(own[1]));
    }
}

Json Json::array(std::initializer_list<JsonItem> items) {
    std::vector<Json> entries;
    entries.reserve(items.size());
    for (const JsonItem& item : items) entries.push_back(item.take());
    return of(std::move(entries));
}

Json Json::object() {
    Json json;
    json.value_.emplace<Object>();
    return json;
}

Json Json::of(std::vector<Json> entries) {
    Json json;
    json.value_ = std::move(entries);
    return json;
}

std::size_t Json::size() const {
    const auto* const object = std::get_if<Object>(&value_);
    return object != nullptr ? object->keys.size() : entries().size();
}

void Json::push_back(Json entry) {
    if (is_null()) value_.emplace<std::vector<Json>>();
    std::get<std::vector<Json>>(value_).push_back(std::move(entry));
}

std::span<const Json> Json::entries() const {
    const auto* const list = std::get_if<std::vector<Json>>(&value_);
    return list == nullptr ? std::span<const Json>() : std::span<const Json>(*list);
}

std::span<Json> Json::own_entries() {
    auto* const list = std::get_if<std::vector<Json>>(&value_);
    return list == nullptr ? std::span<Json>() : std::span<Json>(*list);
}

std::vector<Json::Member> Json::items() const {
    std::vector<Member> all;
    if (const auto* const object = std::get_if<Object>(&value_))
        for (std::size_t i = 0; i < object->keys.size(); ++i)
            all.push_back({object->keys[i], object->values[i]});
    return all;
}

const Json* Json::find(std::string_view key) const {
    const auto* const object = std::get_if<Object>(&value_);
    if (object == nullptr) return nullptr;
    const auto at = std::find(object->keys.begin(), object->keys.end(), key);
    return at == object->keys.end() ? nullptr : &object->values[at - object->keys.begin()];
}

Json& Json::operator[](std::string_view key) {
    if (is_null()) value_.emplace<Object>();
    auto& object = std::get<Object>(value_);
    const auto at = std::find(object.keys.begin(), object.keys.end(), key);
    if (at != object.keys.end()) return object.values[at - object.keys.begin()];
    add_member(std::string(key), Json());
    return object.values.back();
}

const Json& Json::operator[](std::string_view key) const {
    static const Json none;
    const Json* const found = find(key);
    return found == nullptr ? none : *found;
}

void Json::add_member(std::string key, Json value) {
    auto& object = std::get<Object>(value_);
    object.values.push_back(std::move(value));
    try {
        object.keys.push_back(std::move(key));
    } catch (...) {
        object.values.pop_back(); // as many as keys
        throw;
    }
}

void Json::erase(std::string_view key) {
    auto* const object = std::get_if<Object>(&value_);
    if (object == nullptr) return;
    const auto at = std::find(object->keys.begin(), object->keys.end(), key);
    if (at == object->keys.end()) return;
    object->values.erase(object->values.begin() + (at - object->keys.begin()));
    object->keys.erase(at);
}

void Json::update(Json other) {
    if (auto* const object = std::get_if<Object>(&other.value_))
        for (std::size_t i = 0; i < object->keys.size(); ++i)
            (*this)[object->keys[i]] = std::move(object->values[i]);
}

namespace {

/// Writes values with one number of spaces per level, or on one line.
class JsonPrinter {
public:
    JsonPrinter(int indent, bool ascii) : indent_(indent), ascii_(ascii) {}

    void print(const Json& json, int level = 0) {
        if (json.is_object())
            list(json.items(), '{', '}', level, [&](const Json::Member& m) {
                quote(m.key);
                text += indent_ < 0 ? ":" : ": ";
                print(m.value, level + 1);
            });
        else if (json.is_array())
            list(json.entries(), '[', ']', level, [&](const Json& v) { print(v, level + 1); });
        else if (json.is_string())
            quote(json.text());
        else
            word(json);
    }

    std::string text{};

private:
    template <class List, class Print>
    void list(const List& values, char open, char close, int level, const Print& print_one) {
        text += open;
        bool first = true;
        for (const auto& value : values) {
            if (!std::exchange(first, false)) text += ',';
            new_line(level + 1);
            print_one(value);
        }
        if (!first) new_line(level);
        text += close;
    }
    void new_line(int level) {
        if (indent_ < 0) return;
        text += '\n';
        text.append(static_cast<std::size_t>(indent_) * static_cast<std::size_t>(level), ' ');
    }
    /// JSON has no infinity: the largest double stands for what is beyond it.
    static double in_range(double value) {
        constexpr double largest = std::numeric_limits<double>::max();
        return std::isnan(value) ? value : std::clamp(value, -largest, largest);
    }
    // Values without others in them need no memory to be destroyed.
    void quote(const std::string& string) {
        using Other = nlohmann::json;
        text += Other(string).dump(-1, ' ', ascii_, Other::error_handler_t::replace);
    }
    void word(const Json& json) {
        if (json.is_null())
            text += "null";
        else if (json.is_boolean())
            text += json.get<bool>() ? "true" : "false";
        else if (!json.is_number_integer())
            text += nlohmann::json(in_range(json.get<double>())).dump();
        else if (json.get<double>() < 0)
            text += std::to_string(json.get<std::int64_t>());
        else
            text += std::to_string(json.get<std::uint64_t>());
    }

    int indent_;
    bool ascii_;
};

/// Builds a tree of what nlohmann/json reads. Its members are those of nlohmann::json_sax.
class JsonBuilder : public nlohmann::json_sax<nlohmann::json> {
public:
    bool null() override { return add(Json()); }
    bool boolean(bool value) override { return add(Json(value)); }
    bool number_integer(number_integer_t value) override { return add(Json(value)); }
    bool number_unsigned(number_unsigned_t value) override { return add(Json(value)); }
    bool number_float(number_float_t value, const string_t&) override { return add(Json(value)); }
    bool string(string_t& value) override { return add(Json(std::move(value))); }
    bool binary(binary_t&) override { return false; } // no text has any
    bool start_object(std::size_t) override { return open(Json::object()); }
    bool start_array(std::size_t) override { return open(Json::array()); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }
    bool key(string_t& value) override {
        Level& level = open_.back();
        level.is_repeated = !level.keys.insert(value).second;
        if (level.is_repeated && made.repeated.empty()) made.repeated = value;
        level.key = std::move(value);
        return true;
    }
    bool parse_error(std::size_t byte, const std::string&,
                     const nlohmann::json::exception& flaw) override {
        constexpr int out_of_range = 406; // a number that no double can hold
        made.state = flaw.id == out_of_range ? ParsedJson::State::number_too_large
                                             : ParsedJson::State::no_json;
        made.byte = byte;
        return false;
    }

    ParsedJson made{};

private:
    static constexpr std::size_t most_levels = 100;

    /// An array or object that is not complete.
    struct Level {
        Json value;
        std::string key{};            ///< of an object: the last one
        std::set<std::string> keys{}; ///< of an object: all
        bool is_repeated = false;     ///< whether the last key was there before
    };

    bool open(Json value) {
        if (open_.size() == most_levels) {
            made.state = ParsedJson::State::nested_too_deeply;
            return false;
        }
        open_.push_back({std::move(value)});
        return true;
    }
    bool close() {
        Json value = std::move(open_.back().value);
        open_.pop_back();
        return add(std::move(value));
    }
    bool add(Json value) {
        if (open_.empty())
            made.value = std::move(value);
        else if (Level& level = open_.back(); level.value.is_array())
            level.value.push_back(std::move(value));
        else if (level.is_repeated)
            level.value[level.key] = std::move(value); // the last one counts
        else
            level.value.add_member(std::move(level.key), std::move(value));
        return true;
    }

    std::vector<Level> open_{};
};

} // namespace

std::string Json::dump(int indent, bool ascii) const {
    JsonPrinter printer(indent, ascii);
    printer.print(*this);
    return std::move(printer.text);
}

ParsedJson parse_json_text(std::string_view text) {
    JsonBuilder builder;
    nlohmann::json::sax_parse(text, &builder);
    ParsedJson made = std::move(builder.made);
    // The parser takes a byte of 0 for the end of the text.
    const std::size_t zero = text.find('\0');
    if (made.state == ParsedJson::State::good && zero != text.npos) {
        made.state = ParsedJson::State::no_json;
        made.byte = zero + 1;
    }
    return made;
}

} // namespace terrane::detail
