// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The report page of a command: what the command line knows about it, and writing it.
#pragma once

#include <string>

#include <terrane/cli/options/files.hpp>
#include <terrane/cli/options/statistics.hpp>
#include <terrane/cli/session/console.hpp>
#include <terrane/cli/session/session.hpp>
#include <terrane/io/page/page.hpp>

namespace terrane::cli {

/// Checks before any work is done that the page can be written, and begins it if --report is given.
/// Errors: unsupported in a build without pages, cannot_open.
page::Page plan_page(const FileOptions& files, const Session& session);

/// Takes the unit, and hashes the input files. Call it before surfaces are moved. Errors:
/// cannot_open.
void add_page_inputs(page::Page& page, const FileOptions& files, const Inputs& inputs);

/// Judges a certificate of this run as `terrane verify` does, if a page is wanted, and adds the
/// verdict. Nothing happens without a certificate; one that the run did not write is named.
void add_page_certificate(page::Page& page, const FileOptions& files,
                          const std::string& certificate, bool written, Session& session);

/// Writes the page, with the statistics of the run. Errors: those of writing.
void write_page(page::Page& page, const FileOptions& files, const Json& statistics,
                Session& session);

/// Writes the page and the statistics of a run, as far as they are wanted. Returns the status of a
/// run with this result. Errors: those of writing.
ExitStatus write_run(page::Page& page, const Json& statistics, const FileOptions& files,
                     Session& session, bool good);

} // namespace terrane::cli
