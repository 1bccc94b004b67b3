// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/page/html.hpp>

#include <fmt/format.h>

#include <terrane/algorithms/core/sha256.hpp>

namespace terrane::page {
namespace {

/// Returns the hash of an element's content as a Content-Security-Policy names it.
std::string policy_hash(std::string_view content) {
    const Hash hash = sha256(content);
    return "'sha256-" + base64_of({reinterpret_cast<const char*>(hash.data()), hash.size()}) + "'";
}

/// Returns JSON that an HTML element can hold: no '<' can end it.
std::string embedded(const Json& json) {
    std::string text;
    for (const char c : json.dump(-1, true))
        if (c == '<')
            text += "\\u003c";
        else
            text += c;
    return text;
}

std::string block_of(const Json& content, const Arrays& arrays) {
    const std::string json = content.dump();
    std::string bytes;
    for (unsigned i = 0; i < 4; ++i) bytes += static_cast<char>(json.size() >> (8 * i) & 255U);
    return bytes + json + arrays.bytes();
}

} // namespace

std::string content_policy(std::string_view script, std::string_view style) {
    return fmt::format("default-src 'none'; script-src {}; style-src {}; img-src data: blob:; "
                       "base-uri 'none'; form-action 'none'",
                       script.empty() ? "'none'" : policy_hash(script), policy_hash(style));
}

std::string html_of(const Json& content, const Arrays& arrays, const Json& run,
                    const Bundle& bundle) {
    std::string page = fmt::format(
        R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="{}">
<title>Terrane report</title>
<style>)",
        content_policy(bundle.script, bundle.style));
    page += bundle.style;
    page +=
        "</style>\n</head>\n<body>\n<noscript>This report is drawn by its own JavaScript, which "
        "is switched off.</noscript>\n"
        "<script type=\"application/octet-stream\" id=\"terrane-data\">";
    page += base64_of(gzipped(block_of(content, arrays)));
    page += "</script>\n<script type=\"application/json\" id=\"terrane-run\">";
    page += embedded(run);
    page += "</script>\n<script>";
    page += bundle.script;
    page += "</script>\n</body>\n</html>\n";
    return page;
}

} // namespace terrane::page
