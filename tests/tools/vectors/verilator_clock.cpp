// The clock of the bench under Verilator.
#include "Vvectors_bench.h"
#include "verilated.h"

int main(int argc, char** argv) {
  VerilatedContext context;
  context.commandArgs(argc, argv);
  Vvectors_bench bench(&context);
  while (!context.gotFinish()) {
    bench.clk = !bench.clk;
    bench.eval();
    context.timeInc(1);
  }
  bench.final();
  return 0;
}
