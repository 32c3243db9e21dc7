#pragma once

#include <exception>
#include <string>

namespace listric {

/// Notes how much memory, bytes, what is under way needs: for the message, if memory gives out.
/// Kept for the whole process, since it may give out on any thread.
void note_memory_need(double bytes);

/// Size that was noted last; 0: none.
double noted_memory_need();

/// The message of an exception for people: of std::bad_alloc, that memory is short.
std::string words_of(const std::exception& error);

/// "; the limit of 42 MB (ulimit -v) is for the program and its libraries, too" where there is such
/// a limit, else nothing.
std::string words_of_address_limit();

/// Lays memory by that is given back where there is no more, before std::bad_alloc is thrown: what
/// ends then may need some, as destructors of JSON do, which must not throw.
void keep_memory_for_the_end();

} // namespace listric
