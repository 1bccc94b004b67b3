# SPDX-License-Identifier: LGPL-3.0-or-later
# cmake -DPROGRAM=... -DCASE=... -DWORK=... -P program.cmake
# Runs the program: it writes a certificate and exact coordinates of a case, and judges a valid certificate
# (0), an edited input (1), a broken certificate (2) and a missing file (2).
function(expect status)
  execute_process(COMMAND ${PROGRAM} ${ARGN} RESULT_VARIABLE found OUTPUT_VARIABLE output
                  ERROR_VARIABLE errors WORKING_DIRECTORY ${WORK})
  if(NOT found EQUAL status)
    message(FATAL_ERROR "${ARGN}: status ${found}, not ${status}\n${output}${errors}")
  endif()
  set(output "${output}${errors}" PARENT_SCOPE)
endfunction()

function(expect_text part)
  string(FIND "${output}" "${part}" place)
  if(place EQUAL -1)
    message(FATAL_ERROR "\"${part}\" is missing in:\n${output}")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK}/out)
configure_file(${CASE}/input.obj ${WORK}/input.obj COPYONLY)

expect(0 arrange input.obj -o out/mesh.obj --certificate out/c.json --exact out/e.txt)
expect_text("wrote out/c.json")
expect(0 verify out/c.json)
expect_text("valid")
expect(0 verify out/c.json input.obj --json)
expect_text("\"valid\": true")
file(READ ${WORK}/out/e.txt exact)
if(NOT exact MATCHES "^terrane-exact 1\n.*\nend\n$")
  message(FATAL_ERROR "out/e.txt is not as it should be")
endif()

# The input beside the certificate has another name: only its bytes matter.
file(COPY_FILE ${WORK}/input.obj ${WORK}/renamed.xyz)
expect(0 verify out/c.json renamed.xyz)
file(APPEND ${WORK}/input.obj "# edited\n")
expect(1 verify out/c.json)
expect_text("R9")
file(WRITE ${WORK}/input.obj "no OBJ at all")
expect(1 verify out/c.json)
expect_text("another SHA-256")
file(REMOVE ${WORK}/input.obj)
expect(2 verify out/c.json)
expect(2 verify out/c.json renamed.xyz renamed.xyz)
expect(2 verify out/none.json)

file(READ ${WORK}/out/c.json certificate)
string(REPLACE "\"clean\":true" "\"clean\":false" flipped "${certificate}")
file(WRITE ${WORK}/out/flipped.json "${flipped}")
expect(1 verify out/flipped.json renamed.xyz)
expect_text("R11")
string(REPLACE "\"version\":1" "\"version\":2" other "${certificate}")
file(WRITE ${WORK}/out/other.json "${other}")
expect(2 verify out/other.json renamed.xyz)
expect_text("out/other.json, version: this version is not known")
file(WRITE ${WORK}/out/cut.json "{\"format\":")
expect(2 verify out/cut.json)
expect_text("line 1")

# Nothing is written where it can't be certified.
expect(2 arrange - --format obj -o out/m.obj --certificate out/m.json)
expect(2 arrange renamed.xyz -o out/m.obj --certificate none/m.json)
if(EXISTS ${WORK}/out/m.obj OR EXISTS ${WORK}/out/m.json)
  message(FATAL_ERROR "something was written")
endif()
