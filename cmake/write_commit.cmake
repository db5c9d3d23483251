# Writes HEADER: the commit of the checkout SOURCE, with "-modified" when files that git knows differ from it;
# "unknown" where there is no checkout.
set(commit "unknown")
execute_process(COMMAND git -C "${SOURCE}" describe --always --abbrev=12 --exclude=* --dirty=-modified
  OUTPUT_VARIABLE described RESULT_VARIABLE failed ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
if(NOT failed AND described)
  set(commit "${described}")
endif()
set(text "#pragma once\n#define LINEWRIGHT_COMMIT \"${commit}\"\n")
if(EXISTS "${HEADER}")
  file(READ "${HEADER}" before)
endif()
if(NOT "${before}" STREQUAL "${text}")
  file(WRITE "${HEADER}" "${text}")
endif()
