#!/bin/bash
# wasm-libraries.sh FOLDER: sources of Debian in FOLDER/sources, and in FOLDER LLVM's C++ library for WebAssembly, made of
# them: Debian's own knows neither exceptions nor paths. pugixml is compiled with the module.
set -eo pipefail
own=$(realpath "$(dirname "$0")")
mkdir -p "$1"/{sources,lists/partial,headers/sys}
cd "$1"
folder=$PWD
[[ -e lib/libc++.a ]] && exit
# Libraries that are headers alone; the rest of /usr/include is of this system.
ln -sfn /usr/include/{fmt,nlohmann,toml++} /usr/include/eigen3/{Eigen,unsupported} headers
touch headers/sys/statvfs.h # wasm-calls.h has its content

. /etc/os-release
key=/usr/share/keyrings/debian-archive-keyring.gpg
echo "deb-src [signed-by=$key] http://deb.debian.org/debian $VERSION_CODENAME main" >sources.list
own_lists=(-q -o Dir::Etc::sourcelist="$folder/sources.list" -o Dir::Etc::sourceparts=/dev/null
    -o Dir::State::lists="$folder/lists" -o APT::Sandbox::User=root) # its user may not write here
cd sources
apt-get "${own_lists[@]}" update >/dev/null
apt-get "${own_lists[@]}" source --tar-only --download-only llvm-toolchain-19 pugixml >/dev/null
tar -xf llvm-toolchain-19_*.orig.tar.xz --strip-components=1 --wildcards \
    '*/libcxx' '*/libcxxabi' '*/libunwind' '*/runtimes' '*/cmake'
tar -xf pugixml_*.orig.tar.* --strip-components=2 --wildcards '*/src/pugi*'
cd ..

# No tests, no threads; `UNIX`: WASI is near enough to it.
cmake -G Ninja -S sources/runtimes -B runtimes -D CMAKE_TOOLCHAIN_FILE="$own/wasm.cmake" \
    -D CMAKE_CXX_FLAGS_MINSIZEREL="-Os -DNDEBUG -I$folder/headers -include $own/wasm-calls.h" -D CMAKE_BUILD_TYPE=MinSizeRel -D CMAKE_INSTALL_PREFIX="$folder" -D UNIX=ON \
    -D LLVM_ENABLE_RUNTIMES='libunwind;libcxxabi;libcxx' -D LLVM_INCLUDE_TESTS=OFF -D LLVM_INCLUDE_DOCS=OFF \
    -DLIBCXX_ENABLE_{SHARED,THREADS,BENCHMARKS,RANDOM_DEVICE}=OFF -DLIBCXX_INCLUDE_{TESTS,BENCHMARKS}=OFF \
    -D LIBCXX_CXX_ABI=libcxxabi -D LIBCXX_HAS_MUSL_LIBC=ON -D LIBCXX_ENABLE_FILESYSTEM=ON \
    -DLIBCXXABI_ENABLE_{SHARED,THREADS}=OFF -D LIBCXXABI_INCLUDE_TESTS=OFF -D LIBCXXABI_SILENT_TERMINATE=ON \
    -D LIBCXXABI_USE_LLVM_UNWINDER=ON -DLIBUNWIND_ENABLE_{SHARED,THREADS}=OFF -D LIBUNWIND_HIDE_SYMBOLS=ON -D LIBUNWIND_INCLUDE_TESTS=OFF >/dev/null
cmake --build runtimes --target install >/dev/null
llvm-ar-19 d lib/libunwind.a UnwindRegisters{Save,Restore}.S.o # empty, and no WebAssembly
