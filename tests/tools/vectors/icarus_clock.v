// The clock of the bench under Icarus Verilog.
module icarus_clock;
  reg clk = 0;
  always #1 clk = !clk;
  vectors_bench bench (.clk(clk));
endmodule
