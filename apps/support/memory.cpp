#include "apps/support/memory.hpp"

#include <atomic>

namespace listric {

namespace {

std::atomic<double> need = 0.0;

} // namespace

void note_memory_need(double bytes) { need = bytes; }

double noted_memory_need() { return need; }

} // namespace listric
