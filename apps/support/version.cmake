# Writes version.cpp, only if it changes. Runs in every build (cmake/library.cmake).

# Only a clone of its own counts: an unpacked archive may lie inside somebody else's repository.
set(commit "")
if(EXISTS ${source}/.git)
  set(ENV{GIT_OPTIONAL_LOCKS} 0)
  execute_process(COMMAND git -C ${source} describe --always --dirty --exclude=*
    OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
  if(NOT failed AND commit)
    string(PREPEND commit "+")
  endif()
endif()

# hash_of(RESULT FOLDER): of the names and contents of the C++ files of a folder.
function(hash_of result folder)
  file(GLOB_RECURSE files RELATIVE ${source} ${source}/${folder}/*.cpp ${source}/${folder}/*.hpp)
  list(SORT files)
  set(hashes "")
  foreach(file IN LISTS files)
    file(SHA256 ${source}/${file} hash)
    string(APPEND hashes "${file} ${hash}\n")
  endforeach()
  string(SHA256 hash "${hashes}")
  string(SUBSTRING ${hash} 0 16 hash)
  set(${result} ${hash} PARENT_SCOPE)
endfunction()
hash_of(hash dem)
hash_of(measures_hash apps/measures)

file(CONFIGURE OUTPUT ${output} @ONLY CONTENT [[
#include "apps/support/version.hpp"

namespace listric {

const std::string_view version = R"(@version@@commit@)";
const std::string_view source_hash = "@hash@";
const std::string_view measures_hash = "@measures_hash@";
const std::string_view compiler = R"(@compiler@)";
const std::string_view build_flags = R"(@build_flags@)";
#if defined __AVX512F__
const std::string_view instruction_set = "avx512";
#elif defined __AVX2__
const std::string_view instruction_set = "avx2";
#elif defined __AVX__
const std::string_view instruction_set = "avx";
#else
const std::string_view instruction_set = "baseline";
#endif

} // namespace listric
]])
