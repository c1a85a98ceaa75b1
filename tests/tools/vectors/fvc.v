// Frequent Values Collector: fully associative, evicts the smallest count, takes one pixel per clock.
// Ties go to the lowest slot.
module fvc #(
  parameter PIXEL_BITS = 32,
  parameter COUNT_BITS = 32,
  parameter ENTRIES    = 64,
  parameter INDEX_BITS = 6  // log2 of ENTRIES
) (
  input  wire                             clk,
  input  wire                             clear,  // empties all slots
  // Sets a slot, {valid, colour, count}.
  input  wire                             slot_write,
  input  wire [INDEX_BITS-1:0]            slot_index,
  input  wire [PIXEL_BITS+COUNT_BITS:0]   slot_entry,
  // Takes a pixel. In this clock the outputs say what becomes of it.
  input  wire                             see,
  input  wire [PIXEL_BITS-1:0]            color,
  output reg                              hit,
  output reg                              evicts,
  // Reads a slot.
  input  wire [INDEX_BITS-1:0]            read_index,
  output wire [PIXEL_BITS+COUNT_BITS:0]   read_entry
);
  reg [ENTRIES-1:0]    valid;
  reg [PIXEL_BITS-1:0] colors [0:ENTRIES-1];
  reg [COUNT_BITS-1:0] counts [0:ENTRIES-1];

  assign read_entry = {valid[read_index],
                       valid[read_index] ? colors[read_index] : {PIXEL_BITS{1'b0}},
                       valid[read_index] ? counts[read_index] : {COUNT_BITS{1'b0}}};

  // The slot that the pixel goes to: a hit, else the first empty slot, else the smallest count.
  reg                  has_empty;
  reg [INDEX_BITS-1:0] hit_slot, empty_slot, least_slot;
  reg [COUNT_BITS-1:0] least;
  integer i;
  always @* begin
    hit = 1'b0;
    has_empty = 1'b0;
    hit_slot = {INDEX_BITS{1'b0}};
    empty_slot = {INDEX_BITS{1'b0}};
    least_slot = {INDEX_BITS{1'b0}};
    least = {COUNT_BITS{1'b1}};
    for (i = ENTRIES - 1; i >= 0; i = i - 1) begin
      if (valid[i] && colors[i] == color) begin
        hit = 1'b1;
        hit_slot = i[INDEX_BITS-1:0];
      end
      if (!valid[i]) begin
        has_empty = 1'b1;
        empty_slot = i[INDEX_BITS-1:0];
      end
      if (counts[i] <= least) begin
        least = counts[i];
        least_slot = i[INDEX_BITS-1:0];
      end
    end
    evicts = !hit && !has_empty;
  end
  wire [INDEX_BITS-1:0] slot = hit ? hit_slot : has_empty ? empty_slot : least_slot;

  always @(posedge clk) begin
    if (clear) begin
      valid <= {ENTRIES{1'b0}};
    end else if (slot_write) begin
      valid[slot_index] <= slot_entry[PIXEL_BITS+COUNT_BITS];
      colors[slot_index] <= slot_entry[PIXEL_BITS+COUNT_BITS-1 -: PIXEL_BITS];
      counts[slot_index] <= slot_entry[COUNT_BITS-1:0];
    end else if (see) begin
      valid[slot] <= 1'b1;
      colors[slot] <= color;
      counts[slot] <= hit ? counts[slot] + {{(COUNT_BITS-1){1'b0}}, 1'b1} : {{(COUNT_BITS-1){1'b0}}, 1'b1};
    end
  end
endmodule
