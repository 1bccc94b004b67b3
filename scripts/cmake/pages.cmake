# SPDX-License-Identifier: LGPL-3.0-or-later
# cmake -DPROGRAM=terrane -DFOLDER=... -P pages.cmake
# Writes what the program makes from its --help, as it is installed: share/man/man1/terrane.1 and terrane-COMMAND.1,
# and the completion scripts of bash, zsh and fish.
function(write_output name)
  execute_process(COMMAND ${PROGRAM} ${ARGN} OUTPUT_VARIABLE text COMMAND_ERROR_IS_FATAL ANY)
  file(WRITE ${FOLDER}/${name} "${text}")
endfunction()

file(REMOVE_RECURSE ${FOLDER}) # commands may have gone
execute_process(COMMAND ${PROGRAM} --help OUTPUT_VARIABLE help COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCH "Subcommands:\n(  [^\n]*\n)+" listed "${help}")
string(REGEX MATCHALL "\n  [a-z]+" commands "${listed}")
write_output(man/man1/terrane.1 manual)
foreach(command IN LISTS commands)
  string(STRIP "${command}" command)
  write_output(man/man1/terrane-${command}.1 manual ${command})
endforeach()
write_output(bash-completion/completions/terrane completion bash)
write_output(zsh/vendor-completions/_terrane completion zsh)
write_output(fish/vendor_completions.d/terrane.fish completion fish)
