# spall_add_loops(TARGET SOURCE ...)
# Compiles loops over contacts once per instruction set, with
# SPALL_INSTRUCTION_SET its name, and links them into the target; the program
# takes the widest set that the processor has. Without contraction every set
# gives the same digits. Packs wider than a register are never handed over
# between units. SPALL_LOOP_INCLUDES: the headers of the particle engine, public
# ones and those of its loops.
function(spall_add_loops target)
  set(flags_baseline -Wno-psabi)
  set(flags_avx2 -mavx2)
  # GCC 12 warns of its own header (GCC bug 105593).
  set(flags_avx512 -mavx512f -mavx512dq -mavx512bw -mavx512vl
    -Wno-uninitialized $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
  foreach(set baseline avx2 avx512)
    set(loops ${target}_loops_${set})
    add_library(${loops} OBJECT ${ARGN})
    target_compile_features(${loops} PRIVATE cxx_std_20)
    set_target_properties(${loops} PROPERTIES POSITION_INDEPENDENT_CODE ON)
    target_include_directories(${loops} PRIVATE ${SPALL_LOOP_INCLUDES})
    if(TARGET spall_warnings)
      target_link_libraries(${loops} PRIVATE spall_warnings)
    endif()
    target_compile_definitions(${loops} PRIVATE SPALL_INSTRUCTION_SET=${set}
      $<$<BOOL:${SPALL_WIDE_COLUMNS}>:SPALL_WIDE_COLUMNS>)
    target_compile_options(${loops} PRIVATE ${flags_${set}} -O3
      -fno-math-errno -fno-trapping-math -ffp-contract=off)
    target_sources(${target} PRIVATE $<TARGET_OBJECTS:${loops}>)
  endforeach()
endfunction()
