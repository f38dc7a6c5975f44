# cmake -D TREE=... -D FILE=... -P write_commit.cmake: writes a source that says the commit of a tree (machine.h), if it
# is another than the one there. A tree that differs from its commit has "-dirty" behind it, like git describe's; sources
# that are in no repository of their own are of an unknown one.
set(commit unknown)
get_filename_component(tree "${TREE}" REALPATH)
execute_process(COMMAND git -C "${tree}" rev-parse --show-toplevel
                OUTPUT_VARIABLE top OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
if(NOT failed AND top STREQUAL tree)
  execute_process(COMMAND git -C "${tree}" rev-parse --short=12 HEAD
                  OUTPUT_VARIABLE head OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
  if(NOT failed)
    set(commit ${head})
    execute_process(COMMAND git -C "${tree}" diff --quiet HEAD -- RESULT_VARIABLE changed ERROR_QUIET)
    if(changed)
      string(APPEND commit -dirty)
    endif()
  endif()
endif()
set(text "#include \"cases/runner/machine.h\"\n\nstd::string lahar::cases::commit() { return \"${commit}\"; }\n")
set(former "")
if(EXISTS "${FILE}")
  file(READ "${FILE}" former)
endif()
if(NOT text STREQUAL former)
  file(WRITE "${FILE}" "${text}")
endif()
