# Compile options of every target. Results must have the same bits in every build of a binary and at every vector width: no
# contraction into fused multiply-adds, no reordering. Without errno, a loop with a square root is vectorised and runs twice
# as fast.
add_library(drape_options INTERFACE)
target_compile_options(drape_options INTERFACE -fno-math-errno -ffp-contract=off -DEIGEN_MAX_ALIGN_BYTES=64
  -fno-semantic-interposition  # lets a library inline its own functions, as a program does
  -Wall -Wextra -Wpedantic
  # Files compiled as one may have constants of the same name in their unnamed namespaces.
  $<$<CXX_COMPILER_ID:GNU>:$<IF:$<BOOL:$<TARGET_PROPERTY:UNITY_BUILD>>,-Wshadow=local,-Wshadow>>)
target_include_directories(drape_options INTERFACE ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/include)

if(DRAPE_SANITIZE)
  # UBSan takes more compile time than everything else together. Its null check is omitted, because a null pointer ends the
  # program anyway, and so is all of it in the tests' own code (targets with DRAPE_TEST).
  target_compile_options(drape_options INTERFACE -fsanitize=${DRAPE_SANITIZE} -fno-sanitize=null -fno-sanitize-recover=undefined
                         -fno-omit-frame-pointer
                         $<$<BOOL:$<TARGET_PROPERTY:DRAPE_TEST>>:-fno-sanitize=undefined>)
  target_link_options(drape_options INTERFACE -fsanitize=${DRAPE_SANITIZE})
  target_compile_definitions(drape_options INTERFACE DRAPE_SANITIZED)  # compilers name this macro differently
endif()

# For code that runs about once per build, or only reads a command line and composes text: optimising takes half of its compile
# time. Not for code that a benchmark links: the linker keeps one copy of each inline function. With GCC a precompiled header
# has its own optimisation level, so such a target cannot reuse another's.
function(drape_optimise_less target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()

# Adds every source of this folder and of some below it to a target: a new file needs no line in a CMakeLists.txt.
function(drape_sources target) # FOLDER...
  list(TRANSFORM ARGN APPEND /*.cpp)
  file(GLOB files CONFIGURE_DEPENDS *.cpp ${ARGN})
  target_sources(${target} PRIVATE ${files})
endfunction()
