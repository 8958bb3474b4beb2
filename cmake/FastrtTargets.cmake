# What every object of fastrt is compiled with, and how its libraries of objects are made.

add_library(fastrt_options INTERFACE)
target_compile_features(fastrt_options INTERFACE cxx_std_20)
target_include_directories(fastrt_options INTERFACE ${PROJECT_SOURCE_DIR})
target_compile_options(fastrt_options INTERFACE -Wall -Wextra -Wconversion -Wshadow -fno-math-errno)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # gcc 12's false alarms: overlaps in "text" + std::string, bounds of std::vector's own copies. clang looks too.
  target_compile_options(fastrt_options INTERFACE -Wno-restrict -Wno-array-bounds
                         -Wno-stringop-overflow -Wno-stringop-overread)
endif()
if(FASTRT_WERROR)
  target_compile_options(fastrt_options INTERFACE -Werror)
endif()
if(FASTRT_ASSERTS)
  target_compile_definitions(fastrt_options INTERFACE FASTRT_ASSERTS=1)
endif()

# What users of the library need too. Contraction would break the equality of the paths (docs/numerics.md).
add_library(fastrt_public INTERFACE)
target_compile_features(fastrt_public INTERFACE cxx_std_20)
target_compile_options(fastrt_public INTERFACE -ffp-contract=off)
target_include_directories(fastrt_public INTERFACE
  $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
target_link_libraries(fastrt_public INTERFACE glm::glm)

# xsimd's own target links xtl, which Debian's libxsimd-dev does not bring.
add_library(fastrt_xsimd INTERFACE)
target_include_directories(fastrt_xsimd SYSTEM INTERFACE ${xsimd_INCLUDE_DIRS})

# fastrt_object_library(NAME FOLDER [LIBRARIES ...]): all .cpp files of src/FOLDER as objects.
function(fastrt_object_library name folder)
  cmake_parse_arguments(ARG "" "" "LIBRARIES" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${folder}/*.cpp)
  add_library(${name} OBJECT ${sources})
  target_link_libraries(${name} PRIVATE fastrt_options fastrt_public OpenMP::OpenMP_CXX ${ARG_LIBRARIES})
  set_target_properties(${name} PROPERTIES POSITION_INDEPENDENT_CODE ON)
endfunction()

# fastrt_kernels(ISA FLAGS...): the kernels for one instruction set, from the same text. One object, one ISA, one set
# of flags; FASTRT_ISA_NAMESPACE keeps every inline function of one object apart from the others'.
function(fastrt_kernels isa)
  set(name fastrt_kernels_${isa})
  add_library(${name} OBJECT ${CMAKE_CURRENT_SOURCE_DIR}/kernels/kernel_table.cpp)
  target_link_libraries(${name} PRIVATE fastrt_options fastrt_public fastrt_xsimd)
  target_compile_definitions(${name} PRIVATE FASTRT_ISA_NAMESPACE=${isa} FASTRT_XSIMD_NAMESPACE=xsimd_${isa})
  # Sanitizers stay out: instrumented, one such object takes the compiler many minutes and over a gigabyte. The kernels
  # touch fixed arrays alone; `valgrind build/release/fastrt --isa avx2 ...` watches them.
  target_compile_options(${name} PRIVATE -O3 -fno-exceptions -fno-sanitize=all ${ARGN})
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # gcc 12's own AVX-512 header warns.
    target_compile_options(${name} PRIVATE -Wno-uninitialized -Wno-maybe-uninitialized)
  endif()
  set_target_properties(${name} PROPERTIES POSITION_INDEPENDENT_CODE ON)
endfunction()
