# cmake -D SOURCE=DIR -D FILE=commit.cc -P commit.cmake
# Writes the commit of SOURCE into FILE, which is touched only if it differs.
find_program(GIT_PROGRAM git)
set(commit unknown)
if(GIT_PROGRAM AND EXISTS ${SOURCE}/.git)
  execute_process(COMMAND ${GIT_PROGRAM} -C ${SOURCE} rev-parse HEAD
    RESULT_VARIABLE status OUTPUT_VARIABLE found ERROR_QUIET
    OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(status EQUAL 0)
    set(commit ${found})
  endif()
endif()
set(text "#include \"program/version.h\"\n
namespace spall
{
const char *const source_commit = \"${commit}\";
} // namespace spall\n")
set(before "")
if(EXISTS ${FILE})
  file(READ ${FILE} before)
endif()
if(NOT before STREQUAL text)
  file(WRITE ${FILE} "${text}")
endif()
