// VDCP block decoder: restores one 2x2 sub-block per clock from CSB, payload and rCCD (codec/dcp/vdcp_scheme.cpp
// draws the bits).
module vdcp_decoder #(
  parameter PIXEL_BITS = 32,
  parameter ENTRIES    = 64,
  parameter INDEX_BITS = 6,  // log2 of ENTRIES
  parameter WIDTH_BITS = 3   // ceil(log2(INDEX_BITS + 2)): bits of a width in the CSB
) (
  input  wire                     clk,
  // Writes an entry of the rCCD, {valid, colour}.
  input  wire                     ccd_write,
  input  wire [INDEX_BITS-1:0]    ccd_index,
  input  wire [PIXEL_BITS:0]      ccd_entry,
  // Begins a block. Sixteen clocks with out_valid follow.
  input  wire                     start,
  input  wire [16*WIDTH_BITS-1:0] csb,
  input  wire [64*PIXEL_BITS-1:0] payload,
  // A sub-block: its four pixels, the first one highest.
  output reg                      out_valid,
  output reg  [3:0]               out_sub_block,
  output reg  [4*PIXEL_BITS-1:0]  out_pixels,
  output reg                      out_error,  // a width or an index that no encoder writes
  output reg  [15:0]              out_bits    // payload bits of the block so far
);
  localparam RAW_BITS = 4 * PIXEL_BITS;

  reg [PIXEL_BITS:0] ccd [0:ENTRIES-1];
  reg                      busy;
  reg [3:0]                sub_block;
  reg [16*WIDTH_BITS-1:0]  csb_left;      // the next width is highest
  reg [64*PIXEL_BITS-1:0]  payload_left;  // the next bit is highest

  initial begin
    busy = 1'b0;
    out_valid = 1'b0;
    out_bits = 16'd0;
  end

  // The sub-block at hand.
  wire [WIDTH_BITS-1:0]   width  = csb_left[16*WIDTH_BITS-1 -: WIDTH_BITS];
  wire                    raw    = &width;
  wire [4*INDEX_BITS-1:0] head   = payload_left[64*PIXEL_BITS-1 -: 4*INDEX_BITS];
  wire [31:0]             width4 = {{(30-WIDTH_BITS){1'b0}}, width, 2'b00};
  wire [31:0]             taken  = raw ? RAW_BITS : width4;

  reg [RAW_BITS-1:0]     pixels;
  reg                    error;
  reg [4*INDEX_BITS-1:0] shifted;
  reg [INDEX_BITS-1:0]   index;
  integer i;
  always @* begin
    pixels = payload_left[64*PIXEL_BITS-1 -: RAW_BITS];
    error = 1'b0;
    shifted = head;
    index = {INDEX_BITS{1'b0}};
    if (!raw) begin
      error = {{(32-WIDTH_BITS){1'b0}}, width} > INDEX_BITS;
      for (i = 0; i < 4; i = i + 1) begin
        index = shifted[4*INDEX_BITS-1 -: INDEX_BITS] >> (INDEX_BITS - {{(32-WIDTH_BITS){1'b0}}, width});
        shifted = shifted << width;
        pixels[(3-i)*PIXEL_BITS +: PIXEL_BITS] = ccd[index][PIXEL_BITS-1:0];
        if (!ccd[index][PIXEL_BITS]) error = 1'b1;
      end
    end
  end

  always @(posedge clk) begin
    if (ccd_write) ccd[ccd_index] <= ccd_entry;
    out_valid <= busy;
    if (start) begin
      busy <= 1'b1;
      sub_block <= 4'd0;
      csb_left <= csb;
      payload_left <= payload;
      out_bits <= 16'd0;
    end else if (busy) begin
      out_sub_block <= sub_block;
      out_pixels <= pixels;
      out_error <= error;
      out_bits <= out_bits + taken[15:0];
      csb_left <= csb_left << WIDTH_BITS;
      payload_left <= payload_left << taken;
      sub_block <= sub_block + 4'd1;
      busy <= sub_block != 4'd15;
    end
  end
endmodule
