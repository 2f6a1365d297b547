# SPDX-License-Identifier: GPL-3.0-or-later
# bench/run with programs that print their arguments: its help builds nothing, scaling is a sweep over threads, and a
# table is made of each program's samples.
# Called with ROOT (the project) and SCRATCH.

cmake_minimum_required(VERSION 3.25)

set(programs ${SCRATCH}/build/release/bench)
set(executable OWNER_READ OWNER_WRITE OWNER_EXECUTE)

function(add_script file text)
  file(WRITE ${file} "#!/bin/sh\n${text}\n")
  file(CHMOD ${file} PERMISSIONS ${executable})
endfunction()

# Runs bench/run with the arguments and sets `code` and `out`.
function(run)
  execute_process(COMMAND ${CMAKE_COMMAND} -E env PATH=${SCRATCH}/bin:$ENV{PATH} bash ${SCRATCH}/bench/run ${ARGN}
    OUTPUT_VARIABLE out ERROR_VARIABLE err RESULT_VARIABLE code)
  set(out "${out}" PARENT_SCOPE)
  set(err "${err}" PARENT_SCOPE)
  set(code "${code}" PARENT_SCOPE)
endfunction()

function(expect_text part)
  string(FIND "${out}" "${part}" found)
  if(NOT code EQUAL 0 OR found EQUAL -1)
    message(FATAL_ERROR "expected code 0 and \"${part}\", found code ${code} and:\n${out}${err}")
  endif()
endfunction()

file(REMOVE_RECURSE ${SCRATCH})
file(COPY ${ROOT}/bench/run DESTINATION ${SCRATCH}/bench)
add_script(${SCRATCH}/bench/build "echo cannot build; exit 9")
add_script(${SCRATCH}/bin/nproc "echo 8")

foreach(words "--help" "-h" "cvt;--help" "scaling;--help" "--rounds;3;--help")
  run(${words})
  expect_text("bench/run scaling ")
endforeach()
run(scalling)
if(NOT code EQUAL 2)
  message(FATAL_ERROR "an unknown word ended with code ${code}")
endif()

add_script(${SCRATCH}/bench/build "echo built: $@")
add_script(${SCRATCH}/bin/python3 "echo table: $@")
add_script(${programs}/delaunay_bench "echo delaunay: $@")
add_script(${programs}/cvt_bench "echo cvt: $@")
foreach(program delaunay cvt)
  run(scaling --rounds 3)
  expect_text("table: -B bench/report build/bench/${program}_bench.json\n")
  set(out "${err}")
  set(samples --benchmark_out=build/bench/${program}_bench.json)
  expect_text("${program}: ${samples} --threads=8 --rows=one-thread,calotte --sweep=2,4 --rounds 3\n")
endforeach()
run(--quick)
set(out "${err}")
expect_text("--rounds 5 --sizes 163842\n")
run(cvt --help)
expect_text("cvt: --help\n")
