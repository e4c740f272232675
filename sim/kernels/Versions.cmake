# The versions of the kernels for the processor that is compiled for. drape_kernels(NAME LANES OPTION...) is called for each,
# slowest first, LANES being the doubles in a vector register.
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  drape_kernels(sse2 2)  # the baseline of x86-64
  drape_kernels(avx2 4 -mavx2)
  drape_kernels(avx512 8 -mavx512f -mavx512dq -mavx512vl -mprefer-vector-width=512)
elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "aarch64|arm64")
  drape_kernels(neon 2)  # the baseline of 64-bit ARM
else()
  drape_kernels(generic 2)  # the compiler translates two lanes into what there is
endif()
