# SPDX-License-Identifier: LGPL-3.0-or-later
# Hardens what is installed, in optimised builds without sanitizers (tests/hardening.py looks for it). The programs read
# files of strangers, so that a flaw of their memory should end them rather than serve an attacker. Neither tests nor
# users of the library inherit any of this.
option(TERRANE_HARDEN "Optimised builds have stack protectors, fortified functions, RELRO, PIE and CET" ON)

set(terrane_hardened_compiling)
set(terrane_hardened_linking)
if(TERRANE_HARDEN AND NOT TERRANE_SANITIZE)
  set(optimised $<CONFIG:Release,RelWithDebInfo,MinSizeRel>)
  # Distributions set a level of fortification, too; -U keeps that from being an error.
  set(terrane_hardened_compiling $<${optimised}:-fstack-protector-strong;-U_FORTIFY_SOURCE;-D_FORTIFY_SOURCE=2>)
  set(terrane_hardened_linking $<${optimised}:LINKER:-z,relro,-z,now,-z,noexecstack>)
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64|i.86)$")
    list(APPEND terrane_hardened_compiling $<${optimised}:-fcf-protection=full>)
  endif()
  include(CheckPIESupported)
  check_pie_supported(LANGUAGES CXX)
endif()

# terrane_harden(TARGET) hardens a program or library. Programs are position-independent, as libraries are already.
function(terrane_harden target)
  if(NOT TERRANE_HARDEN OR TERRANE_SANITIZE)
    return()
  endif()
  target_compile_options(${target} PRIVATE ${terrane_hardened_compiling})
  get_target_property(type ${target} TYPE)
  if(type STREQUAL EXECUTABLE)
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
    target_link_options(${target} PRIVATE ${terrane_hardened_linking})
  elseif(type MATCHES "^(SHARED|MODULE)_LIBRARY$") # the Python module is the latter
    target_link_options(${target} PRIVATE ${terrane_hardened_linking})
  endif()
endfunction()
