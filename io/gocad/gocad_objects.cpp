// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/gocad/gocad_objects.hpp>

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace terrane::detail {

namespace {

bool ends_a_block(std::string_view keyword) {
    constexpr std::array<std::string_view, 8> keywords{
        "GOCAD", "GOCAD_ORIGINAL_COORDINATE_SYSTEM", "TFACE", "VRTX", "PVRTX", "TRGL", "TSURF",
        "END"};
    return std::find(keywords.begin(), keywords.end(), keyword) != keywords.end();
}

void read_entry(std::string_view line, GocadNames& names) {
    const auto colon = line.find_first_of(":=");
    if (colon == std::string_view::npos) return;
    const auto key = lower(trimmed(line.substr(0, colon)));
    if (key == "name") names.name = unquoted(line.substr(colon + 1));
    if (key == "name_in_model_list") names.name_in_model = unquoted(line.substr(colon + 1));
}

class ModelReader {
public:
    ModelReader(LineParser& in, ModelObject& model) : in_(in), model_(model) {}

    MaybeError read() {
        while (again_ || in_.next()) {
            again_ = false;
            Tokens tokens(in_.line());
            const auto keyword = tokens.next();
            if (keyword == "END") return std::nullopt;
            if (keyword == "GOCAD") break;
            if (auto trouble = read_line(keyword, tokens)) return trouble;
        }
        return no_end(in_, model_.line);
    }

private:
    MaybeError read_line(std::string_view keyword, Tokens tokens) {
        if (in_.line().find('{') != std::string_view::npos) read_header();
        if (keyword == "TSURF") model_.surfaces.push_back(unquoted(tokens.rest()));
        if (keyword == "TFACE") return read_part(tokens);
        if (keyword == "REGION") return read_region(tokens);
        if (keyword == "LAYER") {
            auto& layer = model_.layers.emplace_back();
            layer.name = unquoted(tokens.rest());
            return read_list(layer.regions);
        }
        return std::nullopt;
    }

    void read_header() {
        GocadNames names;
        again_ = read_block(in_, names);
        if (!names.name.empty()) model_.name = names.name;
    }

    MaybeError read_id(std::string_view token, std::uint32_t& id) const {
        std::int64_t value = 0;
        if (!parse_integer(token, value) || value < 0 || value > UINT32_MAX)
            return in_.error(ErrorCode::bad_syntax, "expected an id, found " + shown(token));
        id = static_cast<std::uint32_t>(value);
        return std::nullopt;
    }

    MaybeError read_part(Tokens tokens) {
        auto& part = model_.parts.emplace_back();
        part.line = in_.number();
        if (auto trouble = read_id(tokens.next(), part.id)) return trouble;
        part.feature = tokens.next();
        part.surface = unquoted(tokens.rest());
        if (part.surface.empty())
            return in_.error(ErrorCode::bad_syntax,
                             "TFACE needs an id, a feature type and the name of a surface");
        return std::nullopt;
    }

    MaybeError read_region(Tokens tokens) {
        auto& region = model_.regions.emplace_back();
        region.line = in_.number();
        if (auto trouble = read_id(tokens.next(), region.id)) return trouble;
        region.name = unquoted(tokens.rest());
        return read_list(region.sides);
    }

    /// Reads signed integers from the following lines up to a 0.
    MaybeError read_list(std::vector<std::int64_t>& list) {
        const auto begin = in_.number();
        while (in_.next()) {
            Tokens tokens(in_.line());
            for (auto token = tokens.next(); !token.empty(); token = tokens.next()) {
                std::int64_t value = 0;
                if (!parse_integer(token, value) || value < -std::int64_t(UINT32_MAX))
                    return in_.error(ErrorCode::bad_syntax,
                                     shown(token) + " in a list of ids that ends with 0");
                if (value == 0) return std::nullopt;
                list.push_back(value);
            }
        }
        return in_.error_at(begin, ErrorCode::bad_syntax, "the list of ids does not end with 0");
    }

    LineParser& in_;
    ModelObject& model_;
    bool again_ = false; ///< the current line is not processed yet
};

MaybeError read_object(LineParser& in, std::string_view type, GocadFile& file) {
    if (same_ignoring_case(type, "TSurf")) {
        auto& object = file.tsurfs.emplace_back();
        object.line = in.number();
        return read_tsurf(in, object);
    }
    if (same_ignoring_case(type, "Model3d") && !file.model) {
        auto& model = file.model.emplace();
        model.line = in.number();
        return read_model3d(in, model);
    }
    ++file.others[type.empty() ? "object without a type" : std::string(type.substr(0, 40))];
    return std::nullopt;
}

} // namespace

std::string unquoted(std::string_view text) {
    text = trimmed(text);
    if (text.size() >= 2 && text.front() == '"' && text.back() == '"')
        text = text.substr(1, text.size() - 2);
    return std::string(text);
}

Role role_of_feature(std::string_view feature) {
    const auto type = lower(unquoted(feature));
    if (type == "boundary" || type == "lease") return Role::boundary;
    if (type.ends_with("fault")) return Role::fault;
    for (const auto* horizon : {"top", "horizon", "unconformity", "topographic", "paleosurf"})
        if (type == horizon) return Role::horizon;
    return Role::unknown;
}

Error no_end(const LineParser& in, std::size_t line) {
    return in.error(ErrorCode::bad_syntax,
                    fmt::format("the object that begins in line {} has no END", line));
}

bool read_block(LineParser& in, GocadNames& names) {
    auto line = in.line();
    line.remove_prefix(line.find('{') + 1);
    while (true) {
        line = trimmed(line);
        const bool closed = line.ends_with('}');
        if (closed) line.remove_suffix(1);
        read_entry(line, names);
        if (closed || !in.next()) return false;
        line = in.line();
        if (ends_a_block(Tokens(line).next())) return true;
    }
}

MaybeError read_model3d(LineParser& in, ModelObject& model) {
    return ModelReader(in, model).read();
}

MaybeError read_gocad_file(LineParser& in, GocadFile& file) {
    bool found = false, is_archive = false;
    while (in.next()) {
        if (in.number() == 1) is_archive = in.line().starts_with("PK\x03\x04");
        Tokens tokens(in.line());
        if (tokens.next() != "GOCAD") continue;
        found = true;
        if (auto trouble = read_object(in, tokens.next(), file)) return trouble;
    }
    if (found) return std::nullopt;
    return in.file_error(is_archive ? ErrorCode::unsupported : ErrorCode::bad_syntax,
                         is_archive
                             ? "this is a ZIP archive, as RINGMesh writes with the extension "
                               ".gm; save the model as .ml or its surfaces as .ts"
                             : "not a GOCAD file: no line begins with GOCAD");
}

} // namespace terrane::detail
