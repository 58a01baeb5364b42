# SPDX-License-Identifier: BSD-3-Clause
# One INTERFACE target that every target of ours links.
#
# -ffp-contract=off: no multiply-add is fused behind our back, so a kernel gives the same bits whichever loop
# (serial, OpenMP, vectorised) it is inlined into. It is part of the determinism promise, docs/decisions/0002.
add_library(gimdem_options INTERFACE)
target_compile_options(gimdem_options INTERFACE
  $<$<COMPILE_LANGUAGE:CXX>:-Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -ffp-contract=off
    -fno-math-errno>)
# g++ 12 takes the deliberately undefined operand of its own AVX-512 intrinsics for a mistake of ours.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  target_compile_options(gimdem_options INTERFACE
    $<$<COMPILE_LANGUAGE:CXX>:-Wno-uninitialized -Wno-maybe-uninitialized>)
endif()
if(GIMDEM_NATIVE)
  target_compile_options(gimdem_options INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-march=native>)
endif()
if(GIMDEM_WERROR)
  target_compile_options(gimdem_options INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-Werror>)
endif()
if(GIMDEM_SANITIZE AND GIMDEM_SANITIZE_THREADS)
  message(FATAL_ERROR "GIMDEM_SANITIZE and GIMDEM_SANITIZE_THREADS cannot both be on (a program has one of these sanitizers at most); choose one")
endif()
if(GIMDEM_SANITIZE)
  target_compile_options(gimdem_options INTERFACE -fsanitize=address,undefined -fno-omit-frame-pointer)
  target_link_options(gimdem_options INTERFACE -fsanitize=address,undefined)
endif()

if(GIMDEM_SANITIZE_THREADS)
  target_compile_options(gimdem_options INTERFACE -fsanitize=thread)
  target_link_options(gimdem_options INTERFACE -fsanitize=thread)
endif()

add_feature_info(native GIMDEM_NATIVE "tuned for this machine's processor")
add_feature_info(sanitizers GIMDEM_SANITIZE "address and undefined-behaviour sanitizers")
add_feature_info(thread-sanitizer GIMDEM_SANITIZE_THREADS "data races of our own threads")
add_feature_info(cuda GIMDEM_CUDA "backend for GPUs")
