# One interface target that carries the warnings of our own code; -Werror only where LANCER_WERROR asks (CI).
add_library(lancer_warnings INTERFACE)
target_compile_options(lancer_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wold-style-cast -Wno-psabi -Wno-restrict)  # the last: false alarms of g++ 12
option(LANCER_WERROR "Warnings are errors" OFF)
if(LANCER_WERROR)
  target_compile_options(lancer_warnings INTERFACE -Werror)
endif()
