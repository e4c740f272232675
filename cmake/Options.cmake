# What every target of the project is compiled with. Results must have the same bits in every build of a binary and at
# every vector width: no contraction into fused multiply-adds, no reordering. Without errno, a loop with a square root
# vectorises and runs twice as fast.
add_library(drape_options INTERFACE)
target_compile_options(drape_options INTERFACE -fno-math-errno -ffp-contract=off -DEIGEN_MAX_ALIGN_BYTES=64
  -fno-semantic-interposition  # a library's own functions are inlined as a program's are
  -Wall -Wextra -Wpedantic
  # Files that are compiled as one may have constants of the same name in their unnamed namespaces.
  $<$<CXX_COMPILER_ID:GNU>:$<IF:$<BOOL:$<TARGET_PROPERTY:UNITY_BUILD>>,-Wshadow=local,-Wshadow>>)
target_include_directories(drape_options INTERFACE ${PROJECT_SOURCE_DIR})

if(DRAPE_SANITIZE)
  # UBSan takes more time to compile than all else together. A null pointer ends the program without its check as well,
  # and the tests' own code (targets with DRAPE_TEST) does not need any.
  target_compile_options(drape_options INTERFACE -fsanitize=${DRAPE_SANITIZE} -fno-sanitize=null -fno-sanitize-recover=undefined
                         -fno-omit-frame-pointer
                         $<$<BOOL:$<TARGET_PROPERTY:DRAPE_TEST>>:-fno-sanitize=undefined>)
  target_link_options(drape_options INTERFACE -fsanitize=${DRAPE_SANITIZE})
  target_compile_definitions(drape_options INTERFACE DRAPE_SANITIZED)  # every compiler has another name for it
endif()

# For what runs about once for every build of it, or only reads a command line and puts words together: optimising it takes
# half of the time of compiling it. Not for what a benchmark links: of an inline function that several objects have, the
# linker keeps one. With GCC a precompiled header brings its own optimisation, so none of another target can be reused.
function(drape_optimise_less target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()
