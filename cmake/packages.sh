# Packages of Debian 12 and 13, for the launcher and .ci/run, which read this file.
packages=(g++ cmake ninja-build pkg-config libhdf5-dev libtomlplusplus-dev libcli11-dev libfmt-dev
    nlohmann-json3-dev libeigen3-dev libpugixml-dev zlib1g-dev)
figure_packages=(libjs-dygraphs python3-matplotlib) # without them the program runs and draws less
test_packages=(libgtest-dev libgmock-dev libbenchmark-dev python3-gsd python3-segyio python3-gdal python3-jsonschema
    groff-base chromium chromium-driver python3-selenium python3-h5py python3-pandas
    python3-sklearn python3-nbclient python3-nbformat python3-ipykernel mkdocs katex
    python3-paraview xvfb xauth)
fem_packages=(libdeal.ii-dev petsc-dev libopenmpi-dev openmpi-bin gmsh)
ranks_packages=(petsc-dev libopenmpi-dev openmpi-bin)
wasm_packages=(clang-19 lld-19 llvm-19 libclang-rt-19-dev-wasm32 wasi-libc binaryen zopfli nodejs firefox-esr) # for .ci/run page
ci_packages=(clang-14 libclang-rt-14-dev clang-format-14 clang-tidy-14 pyflakes3 ccache git qemu-user zsh fish ffmpeg)
