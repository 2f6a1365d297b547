// SPDX-License-Identifier: GPL-3.0-or-later
// Code without AVX2 finds out whether the rest can run.
#include "consumer.h"
#include "neighbour.h"

#include <iostream>

int main() {
  if (!neighbour::can_run()) {
    std::cout << "skipped: the compiler or the processor has no AVX2\n";
    return 77;
  }
  const int faults = count_faults();
  std::cout << faults << " faults\n";
  return faults == 0 ? 0 : 1;
}
