#!/usr/bin/env bash
# Installs the Debian/Ubuntu packages that are missing, and does nothing when none is.
# usage: tools/install_dependencies.sh [build] [learn] [fuzz] [lint] [bench] [solver] [web] [web-test]     (default: build)
set -euo pipefail

packages=()
programs=()
for group in "${@:-build}"; do
  case "$group" in
    build)
      packages+=(g++ cmake ninja-build libyaml-cpp-dev libcli11-dev libfmt-dev nlohmann-json3-dev
        libpng-dev libboost-dev libgtest-dev libbenchmark-dev)
      programs+=(c++ cmake ninja)
      ;;
    learn)  # LibTorch, a BLAS that is not 10 to 20 times slower than it could be, and oneDNN
      packages+=(libtorch-dev libopenblas0-openmp libdnnl-dev)
      ;;
    fuzz)
      packages+=(clang-14 libclang-rt-14-dev)
      programs+=(clang++)
      ;;
    lint)
      packages+=(clang-format clang-tidy)
      programs+=(clang-format clang-tidy)
      ;;
    bench)  # to compare with; tests and benchmarks do without it where it is missing
      packages+=(libompl-dev)
      ;;
    solver)  # apps/solver without ortools, which is what its tests can do without
      packages+=(python3)
      ;;
    web)  # any Node.js from 18.19 on will do, whoever packaged it; Debian's has npm in a package of its own
      if ! command -v npm >/dev/null ||
        ! node -e 'const [a, b] = process.versions.node.split("."); process.exit(a > 18 || (a == 18 && b >= 19) ? 0 : 1)'; then
        packages+=(nodejs npm)
      fi
      programs+=(node npm)
      ;;
    web-test)  # a font, too: without one the page has no text
      packages+=(chromium fonts-liberation)
      programs+=(chromium)
      ;;
    *)
      echo "unknown group '$group'; the groups are: build learn fuzz lint bench solver web web-test" >&2
      exit 2
      ;;
  esac
done

if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
  absent=()
  for program in "${programs[@]}"; do
    command -v "$program" >/dev/null || absent+=("$program")
  done
  if [[ ${#absent[@]} -gt 0 ]]; then
    echo "There is no apt-get here, and these programs are missing: ${absent[*]}" >&2
    echo "Please install what your system calls: ${packages[*]}" >&2
    exit 1
  fi
  exit 0  # CMake names a missing library itself.
fi

missing=()
for package in "${packages[@]}"; do
  status=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)
  [[ "$status" == installed ]] || missing+=("$package")
done
[[ ${#missing[@]} -gt 0 ]] || exit 0

as_root=()
if [[ $(id -u) -ne 0 ]]; then
  if ! command -v sudo >/dev/null; then
    echo "These packages are missing: ${missing[*]}" >&2
    echo "Please run as root: apt-get install ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
  if [[ "${CI:-}" == true ]]; then
    as_root+=(--non-interactive)
  fi
fi

apt() {
  ${as_root[@]+"${as_root[@]}"} env DEBIAN_FRONTEND=noninteractive \
    apt-get -qq -o Acquire::Retries=3 -o Dpkg::Use-Pty=0 "$@"
}

echo "==> Installing ${missing[*]}"
apt update || echo "The package lists could not be refreshed; trying with those that are here" >&2
apt install --yes --no-install-recommends "${missing[@]}" >/dev/null
