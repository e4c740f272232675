# What every target of the project is compiled with. Results must have the same bits in every build of a binary and at
# every vector width: no contraction into fused multiply-adds, no reordering. Without errno, a loop with a square root
# vectorises and runs twice as fast.
add_library(drape_options INTERFACE)
target_compile_options(drape_options INTERFACE -fno-math-errno -ffp-contract=off -DEIGEN_MAX_ALIGN_BYTES=64 -Wall -Wextra -Wpedantic -Wshadow)
target_include_directories(drape_options INTERFACE ${PROJECT_SOURCE_DIR})
if(DRAPE_SANITIZE)
  # A null pointer ends the program without UBSan's check as well, which takes a third of the time to compile.
  target_compile_options(drape_options INTERFACE -fsanitize=${DRAPE_SANITIZE} -fno-sanitize=null -fno-omit-frame-pointer)
  target_link_options(drape_options INTERFACE -fsanitize=${DRAPE_SANITIZE})
endif()
