#!/usr/bin/env bash
# Builds the fuzzers and runs them for SECONDS altogether; fails when one of them finds a crash.
# usage: tools/fuzz.sh [SECONDS]                                      (default: 60)
#
# For fuzz/<name>_fuzzer.cpp: the committed corpus is fuzz/corpus/<name>, the dictionary is
# fuzz/<name>.dict, new inputs go to build/fuzz/corpus/<name>, crashes to build/fuzz/crashes/<name>.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

seconds=${1:-60}
if ! [[ "$seconds" =~ ^[1-9][0-9]*$ ]]; then
  echo "usage: tools/fuzz.sh [SECONDS], a whole number above 0" >&2
  exit 2
fi

compiler=
for candidate in clang++-14 clang++; do
  if command -v "$candidate" >/dev/null; then
    compiler=$candidate
    break
  fi
done
if [[ -z "$compiler" ]]; then
  echo "Fuzzing needs clang; run tools/install_dependencies.sh fuzz" >&2
  exit 1
fi

shopt -s nullglob
sources=(fuzz/*_fuzzer.cpp)
if [[ ${#sources[@]} -eq 0 ]]; then
  echo "There is no fuzz/*_fuzzer.cpp" >&2
  exit 1
fi

echo "==> Building the fuzzers"
if ! [[ -f build/fuzz/build.ninja && build/fuzz/build.ninja -nt CMakePresets.json ]]; then
  cmake --preset fuzz -D CMAKE_CXX_COMPILER="$compiler" --log-level=WARNING >/dev/null
  touch build/fuzz/build.ninja
fi
programs=("${sources[@]##*/}")
cmake --build --preset fuzz --parallel "$(nproc)" --target "${programs[@]%.cpp}"

share=$(( seconds / ${#sources[@]} > 0 ? seconds / ${#sources[@]} : 1 ))

export ASAN_OPTIONS="${ASAN_OPTIONS:-allocator_may_return_null=1}"
export UBSAN_OPTIONS="${UBSAN_OPTIONS:-print_stacktrace=1}"

for source in "${sources[@]}"; do
  name=$(basename "$source" _fuzzer.cpp)
  found=build/fuzz/corpus/$name
  crashes=build/fuzz/crashes/$name
  seeds=build/fuzz/seeds/$name
  log=build/fuzz/${name}_fuzzer.log
  rm -rf "$seeds"
  mkdir -p "$found" "$crashes" "$seeds"

  files=()
  case "$name" in
    scenario) files=(scenarios/*.yaml) ;;
    training_options) files=(algorithms/*.yaml) ;;
  esac
  if [[ ${#files[@]} -gt 0 ]]; then
    cp "${files[@]}" "$seeds"
  fi

  arguments=(-max_total_time="$share" -timeout=60 -rss_limit_mb=2048 -print_final_stats=1
    -artifact_prefix="$crashes/")
  if [[ -f "fuzz/$name.dict" ]]; then
    arguments+=(-dict="fuzz/$name.dict")
  fi
  corpora=("$found" "$seeds")
  if [[ -d "fuzz/corpus/$name" ]]; then
    corpora+=("fuzz/corpus/$name")
  fi

  echo "==> Running ${name}_fuzzer for $share seconds"
  # New inputs are written to the first corpus only; the others are read.
  if ! "build/fuzz/fuzzers/${name}_fuzzer" "${arguments[@]}" "${corpora[@]}" >"$log" 2>&1; then
    tail -n 60 "$log" >&2
    echo "${name}_fuzzer failed; the input is in $crashes, the whole log in $log" >&2
    exit 1
  fi
  runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
  echo "${name}_fuzzer: ${runs:-?} inputs, no crash"
done
