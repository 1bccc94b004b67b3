// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Codes, errors, and how stages run. The rules of the whole interface are in terrane.h.
#pragma once

#include <stddef.h>
#include <stdint.h>

#if defined(__GNUC__)
#define TERRANE_API __attribute__((visibility("default")))
#else
#define TERRANE_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/// The number of this interface. It changes when programs must be compiled again.
#define TERRANE_ABI_VERSION 1

/// An index that stands for none.
#define TERRANE_NONE UINT32_MAX

/// The code that a function returns: TERRANE_OK or the kind of failure.
typedef int32_t terrane_code;
enum {
    TERRANE_OK = 0,                ///< success
    TERRANE_CANNOT_OPEN = 1,       ///< file missing, unreadable, or not writable
    TERRANE_BAD_SYNTAX = 2,        ///< the file breaks its format
    TERRANE_BAD_NUMBER = 3,        ///< NaN, infinity, or a number that does not fit
    TERRANE_BAD_INDEX = 4,         ///< a triangle names a vertex that does not exist
    TERRANE_UNKNOWN_FORMAT = 5,    ///< extension not known
    TERRANE_UNSUPPORTED = 6,       ///< valid, but not something Terrane handles
    TERRANE_NOTHING_TO_DO = 7,     ///< no surface, no triangle
    TERRANE_WRITE_FAILED = 8,      ///< disk full, or the like
    TERRANE_BAD_OPTION = 9,        ///< an option's value makes no sense
    TERRANE_IMPROPER_CONTACT = 10, ///< triangles meet other than in a shared vertex or edge
    TERRANE_NOT_CLOSED = 11,       ///< a closed surface was needed
    TERRANE_OUT_OF_MEMORY = 12,    ///< not enough memory
    TERRANE_INTERRUPTED = 13,      ///< stop requested by the caller
    TERRANE_TIMED_OUT = 14,        ///< the caller's time limit has passed
    TERRANE_INTERNAL = 15,         ///< an assertion failed: please report
    TERRANE_BAD_ARGUMENT = 100     ///< a null pointer, a handle of another type, or the wrong size
                                   ///< of a struct
};

/// Why a call failed: a code, a sentence and a place.
typedef struct terrane_error terrane_error;
/// How stages run: threads, stop requests and progress. It never changes a result.
typedef struct terrane_run terrane_run;

/// Many short lists of indices: list i begins at values + offsets[i] and ends before values +
/// offsets[i + 1].
typedef struct terrane_lists {
    const uint32_t* offsets; ///< count + 1, ascending from 0; NULL where there are no lists
    const uint32_t* values;  ///< all lists, one after the other
    size_t count;            ///< number of lists
} terrane_lists;

/// Two triangles that meet other than in a shared vertex or edge.
typedef struct terrane_contact {
    uint32_t triangles[2]; ///< their numbers
    int32_t kind;          ///< see terrane_contact_kind_name
    int32_t reserved;      ///< 0
    double place[3];       ///< a common point, rounded to the nearest doubles
} terrane_contact;

/// Receives the progress of a stage, between steps and in the thread that called the stage: the name
/// of the stage and the share that is done, 0 to 1. A result other than 0 requests a stop. It must
/// return normally.
typedef int (*terrane_progress)(const char* stage, double share, void* user);
/// Receives the time that a stage or a step of it took: its path ("arrange/search") and the seconds. Calls
/// may come from several threads at a time.
typedef void (*terrane_timing)(const char* stage, double seconds, void* user);

/// Returns the version of the library, "0.1.0".
TERRANE_API const char* terrane_version(void);
/// Returns the number of the library's interface, to be compared with TERRANE_ABI_VERSION.
TERRANE_API int32_t terrane_abi_version(void);
/// Returns the name of a code in lower case, "bad_number"; "unknown" for other numbers.
TERRANE_API const char* terrane_code_name(terrane_code code);
/// Returns the name of a kind of improper contact: "vertex on edge", "vertex on face", "edges
/// cross", "edges overlap", "edge on face", "crossing", "coplanar overlap"; "unknown" for other
/// numbers.
TERRANE_API const char* terrane_contact_kind_name(int32_t kind);

/// Returns the code of an error; TERRANE_OK for NULL.
TERRANE_API terrane_code terrane_error_code(const terrane_error* error);
/// Returns the sentence of an error, without full stop; "" for NULL.
TERRANE_API const char* terrane_error_sentence(const terrane_error* error);
/// Returns where it is wrong, "basin.ts:1204", "triangle 812", the name of an argument, or "".
TERRANE_API const char* terrane_error_place(const terrane_error* error);
/// Returns place and sentence, "basin.ts:1204: VRTX needs 3 numbers"; "" for NULL.
TERRANE_API const char* terrane_error_message(const terrane_error* error);
/// Frees an error. Other handles stay as they are, and getters of errors return for them what they return for NULL.
TERRANE_API void terrane_error_free(terrane_error* error);

/// Makes a run with one thread, without callbacks. Free it with terrane_run_free. Wherever a run is
/// wanted, NULL stands for such a run. Errors: BAD_ARGUMENT, OUT_OF_MEMORY.
TERRANE_API terrane_code terrane_run_new(terrane_run** out, terrane_error** error);
/// Frees a run that no stage uses any more.
TERRANE_API void terrane_run_free(terrane_run* run);
/// Sets the number of threads; 0: one for each processor. Errors: BAD_ARGUMENT.
TERRANE_API terrane_code terrane_run_set_threads(terrane_run* run, unsigned threads,
                                                 terrane_error** error);
/// Sets the function that receives the progress, and its argument `user`; NULL: none.
/// Errors: BAD_ARGUMENT.
TERRANE_API terrane_code terrane_run_set_progress(terrane_run* run, terrane_progress progress,
                                                  void* user, terrane_error** error);
/// Sets the function that is told how long stages took; NULL: none. Errors: BAD_ARGUMENT.
TERRANE_API terrane_code terrane_run_set_timing(terrane_run* run, terrane_timing timing, void* user,
                                                terrane_error** error);
/// Requests a stop of all stages of this run, from any thread; they fail with TERRANE_INTERRUPTED.
/// It is not for signal handlers. Later stages stop as well, until terrane_run_reset. Errors:
/// BAD_ARGUMENT.
TERRANE_API terrane_code terrane_run_request_stop(terrane_run* run, terrane_error** error);
/// Forgets a stop request. No stage may use the run meanwhile. Errors: BAD_ARGUMENT, OUT_OF_MEMORY.
TERRANE_API terrane_code terrane_run_reset(terrane_run* run, terrane_error** error);
/// Returns 1 if a stop was requested, else 0.
TERRANE_API int terrane_run_stop_requested(const terrane_run* run);

/// Keeps freed memory in the process, where all threads can reuse it, which makes large models
/// faster. This changes settings of the whole process; call it before threads are started, if at
/// all. It has no effect without glibc.
TERRANE_API void terrane_keep_freed_memory(void);
/// Makes lack of memory within GMP a TERRANE_OUT_OF_MEMORY; without this call GMP ends the process.
/// This changes a setting of the whole process; call it before threads are started. Returns 1, or 0
/// if the process has replaced GMP's memory functions by others.
TERRANE_API int terrane_survive_gmp_out_of_memory(void);

#ifdef __cplusplus
}
#endif
