#pragma once

namespace listric {

/// Notes how much memory, bytes, what is under way needs: for the message, if memory gives out.
/// Kept for the whole process, since it may give out on any thread.
void note_memory_need(double bytes);

/// What was noted last; 0: nothing.
double noted_memory_need();

} // namespace listric
