// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/capi/base.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <thread>

#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/intersection/contact_kind.hpp>
#include <terrane/capi/detail/call.hpp>
#include <terrane/capi/detail/handles.hpp>

namespace terrane::capi::detail {
namespace {

/// The error that is handed out where memory does not suffice for another one. It is never freed.
terrane_error* error_without_memory() noexcept {
    static terrane_error error{{}, TERRANE_OUT_OF_MEMORY, "out of memory", {}, "out of memory"};
    return &error;
}

constexpr std::array<const char*, 16> names{"ok",
                                            "cannot_open",
                                            "bad_syntax",
                                            "bad_number",
                                            "bad_index",
                                            "unknown_format",
                                            "unsupported",
                                            "nothing_to_do",
                                            "write_failed",
                                            "bad_option",
                                            "improper_contact",
                                            "not_closed",
                                            "out_of_memory",
                                            "interrupted",
                                            "timed_out",
                                            "internal"};
static_assert(TERRANE_CANNOT_OPEN == static_cast<int>(ErrorCode::cannot_open) + 1);
static_assert(TERRANE_BAD_OPTION == static_cast<int>(ErrorCode::bad_option) + 1);
static_assert(TERRANE_INTERNAL == static_cast<int>(ErrorCode::internal) + 1);

terrane_code hand_out(terrane_code code, const Error& failure, terrane_error** error) noexcept {
    if (!error) return code;
    try {
        *error = new terrane_error{{}, code, failure.sentence, failure.place, failure.message()};
        (*error)->is_whole = true;
    } catch (...) {
        *error = error_without_memory();
        return TERRANE_OUT_OF_MEMORY;
    }
    return code;
}

} // namespace

terrane_code report(const Error& failure, terrane_error** error) noexcept {
    return hand_out(static_cast<terrane_code>(failure.code) + 1, failure, error);
}

terrane_code report(const BadArgument& bad, terrane_error** error) noexcept {
    return hand_out(TERRANE_BAD_ARGUMENT,
                    error_within_memory(ErrorCode::bad_option, bad.sentence, "", bad.argument),
                    error);
}

std::vector<Point3> points_of(const double* numbers, std::size_t count) {
    std::vector<Point3> points(count);
    if (count > 0) std::memcpy(static_cast<void*>(points.data()), numbers, count * sizeof(Point3));
    return points;
}

terrane_code give_lists(const IndexLists<std::uint32_t>* found, terrane_lists* lists) noexcept {
    if (!lists) return TERRANE_BAD_ARGUMENT;
    *lists = {nullptr, nullptr, 0};
    if (!found) return TERRANE_BAD_ARGUMENT;
    if (found->size() > 0) *lists = {found->offsets.data(), found->values.data(), found->size()};
    return TERRANE_OK;
}

void copy_text(std::string_view text, char* buffer, std::size_t size, std::size_t* length) {
    if (length) *length = text.size();
    need_array(buffer, size, "buffer");
    if (size == 0) return;
    const std::size_t kept = std::min(text.size(), size - 1);
    std::memcpy(buffer, text.data(), kept);
    buffer[kept] = '\0';
}

Run run_of(const terrane_run* run) {
    Run made;
    if (!run) return made;
    const terrane_run& given = needed(run, "run");
    made.threads = given.threads;
    made.stop = given.stop.get_token();
    if (given.progress)
        made.progress = [f = given.progress, user = given.progress_user,
                         stop = given.stop](std::string_view stage, double share) mutable {
            if (f(std::string(stage).c_str(), share, user) != 0) stop.request_stop();
        };
    if (given.timing)
        made.timing = [f = given.timing, user = given.timing_user](std::string_view stage,
                                                                   double seconds) {
            f(std::string(stage).c_str(), seconds, user);
        };
    return made;
}

std::vector<terrane_contact> contacts_of(const std::vector<ImproperContact>& contacts) {
    std::vector<terrane_contact> made;
    made.reserve(contacts.size());
    for (const ImproperContact& c : contacts)
        made.push_back({{c.triangles[0], c.triangles[1]},
                        static_cast<std::int32_t>(c.kind),
                        0,
                        {c.place.x, c.place.y, c.place.z}});
    return made;
}

} // namespace terrane::capi::detail

using namespace terrane::capi::detail;

const char* terrane_version(void) {
    return TERRANE_VERSION;
}

int32_t terrane_abi_version(void) {
    return TERRANE_ABI_VERSION;
}

const char* terrane_code_name(terrane_code code) {
    if (code == TERRANE_BAD_ARGUMENT) return "bad_argument";
    const auto index = static_cast<std::size_t>(code);
    return code >= 0 && index < names.size() ? names[index] : "unknown";
}

const char* terrane_contact_kind_name(int32_t kind) {
    if (kind < 0 || kind > static_cast<int>(terrane::ContactKind::coplanar_overlap))
        return "unknown";
    return name_of(static_cast<terrane::ContactKind>(kind)).data();
}

terrane_code terrane_error_code(const terrane_error* error) {
    return known(error) ? error->code : TERRANE_OK;
}

const char* terrane_error_sentence(const terrane_error* error) {
    return known(error) ? error->sentence.c_str() : "";
}

const char* terrane_error_place(const terrane_error* error) {
    return known(error) ? error->place.c_str() : "";
}

const char* terrane_error_message(const terrane_error* error) {
    return known(error) ? error->message.c_str() : "";
}

void terrane_error_free(terrane_error* error) {
    release(error);
}

terrane_code terrane_run_new(terrane_run** out, terrane_error** error) {
    return produce(out, error, [] { return std::make_unique<terrane_run>(); });
}

void terrane_run_free(terrane_run* run) {
    release(run);
}

terrane_code terrane_run_set_threads(terrane_run* run, unsigned threads, terrane_error** error) {
    return call(error, [&] {
        needed(run, "run").threads =
            threads > 0 ? threads : std::max(1U, std::thread::hardware_concurrency());
    });
}

terrane_code terrane_run_set_progress(terrane_run* run, terrane_progress progress, void* user,
                                      terrane_error** error) {
    return call(error, [&] {
        needed(run, "run").progress = progress;
        run->progress_user = user;
    });
}

terrane_code terrane_run_set_timing(terrane_run* run, terrane_timing timing, void* user,
                                    terrane_error** error) {
    return call(error, [&] {
        needed(run, "run").timing = timing;
        run->timing_user = user;
    });
}

terrane_code terrane_run_request_stop(terrane_run* run, terrane_error** error) {
    return call(error, [&] { needed(run, "run").stop.request_stop(); });
}

terrane_code terrane_run_reset(terrane_run* run, terrane_error** error) {
    return call(error, [&] { needed(run, "run").stop = std::stop_source(); });
}

int terrane_run_stop_requested(const terrane_run* run) {
    return known(run) && run->stop.stop_requested() ? 1 : 0;
}

void terrane_keep_freed_memory(void) {
    terrane::keep_freed_memory();
}

int terrane_survive_gmp_out_of_memory(void) {
    return quietly(0, [] { return terrane::throw_on_gmp_out_of_memory() ? 1 : 0; });
}
