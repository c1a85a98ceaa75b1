// Test bench: feeds the files of one frame to the decoder and to the FVC, and compares every pixel, every payload size
// and the final state of the FVC. Needs the frame.vh of a frame of a VDCP scheme, and +dir=FOLDER with files of the
// same numbers. Prints one line that begins with PASS or FAIL.
module vectors_bench (input wire clk);
  `include "frame.vh"
  localparam WIDTH_BITS = CSB_BITS / 16;
  localparam FVC_BITS = 1 + PIXEL_BITS + 32;

  reg [PIXEL_BITS-1:0]    pixels       [0:64*BLOCKS-1];
  reg [63:0]              mask         [0:BLOCKS-1];
  reg [CSB_BITS-1:0]      csb         [0:BLOCKS-1];
  reg [PAYLOAD_WIDTH-1:0] payload     [0:BLOCKS-1];
  reg [15:0]              payload_bits [0:BLOCKS-1];
  reg [PIXEL_BITS:0]      ccd          [0:ENTRIES-1];
  reg [FVC_BITS-1:0]      fvc_before   [0:ENTRIES-1];
  reg [FVC_BITS-1:0]      fvc_after    [0:ENTRIES-1];

  reg [8*200-1:0] dir;
  reg [8*240-1:0] path;
  task fail(input [8*40-1:0] what, input integer block);
    begin
      $display("FAIL %0s, block %0d", what, block);
      $finish;
    end
  endtask

  // Phases: dictionaries in, then for each block 16 sub-blocks out and 64 pixels into the FVC, then the FVC's slots.
  localparam LOAD = 0, START = 1, DECODE = 2, FEED = 3, CHECK = 4, DONE = 5;
  integer phase, block, step, hits, evictions;
  wire [INDEX_BITS-1:0] entry = step[INDEX_BITS-1:0];
  wire [31:0] at = 64 * block + step;

  wire                    out_valid, out_error;
  wire [3:0]              out_sub_block;
  wire [4*PIXEL_BITS-1:0] out_pixels;
  wire [15:0]             out_bits;
  vdcp_decoder #(PIXEL_BITS, ENTRIES, INDEX_BITS, WIDTH_BITS) decoder (
    .clk(clk), .ccd_write(phase == LOAD), .ccd_index(entry), .ccd_entry(ccd[entry]),
    .start(phase == START), .csb(csb[block]), .payload(payload[block]),
    .out_valid(out_valid), .out_sub_block(out_sub_block), .out_pixels(out_pixels), .out_error(out_error),
    .out_bits(out_bits));

  wire hit, evicts;
  wire [FVC_BITS-1:0] slot;
  fvc #(PIXEL_BITS, 32, ENTRIES, INDEX_BITS) collector (
    .clk(clk), .clear(1'b0), .slot_write(phase == LOAD), .slot_index(entry), .slot_entry(fvc_before[entry]),
    .see(phase == FEED && mask[block][63 - step]), .color(pixels[at]), .hit(hit), .evicts(evicts),
    .read_index(entry), .read_entry(slot));

  wire [31:0] first = 64 * block + 4 * {28'd0, out_sub_block};
  wire [4*PIXEL_BITS-1:0] expected = {pixels[first], pixels[first + 1], pixels[first + 2], pixels[first + 3]};

`define READ(name, memory) $sformat(path, "%0s/%0s.hex", dir, name); $readmemh(path, memory);
  initial begin
    if (!$value$plusargs("dir=%s", dir)) dir = ".";
    `READ("pixels", pixels)
    `READ("mask", mask)
    `READ("csb", csb)
    `READ("payload", payload)
    `READ("payload_bits", payload_bits)
    `READ("ccd", ccd)
    `READ("fvc_before_blocks", fvc_before)
    `READ("fvc_after_blocks", fvc_after)
    phase = LOAD;
    block = 0;
    step = 0;
    hits = 0;
    evictions = 0;
  end

  always @(posedge clk) begin
    step <= step + 1;
    case (phase)
      LOAD: if (step == ENTRIES - 1) begin
        phase <= START;
        step <= 0;
      end
      START: phase <= DECODE;
      DECODE: if (out_valid) begin
        if (out_error) fail("bits that no encoder writes", block);
        if (out_pixels != expected) fail("pixel differs", block);
        if (out_sub_block == 4'd15) begin
          if (out_bits != payload_bits[block]) fail("payload size differs", block);
          phase <= FEED;
          step <= 0;
        end
      end
      FEED: begin
        if (mask[block][63 - step] && hit) hits <= hits + 1;
        if (mask[block][63 - step] && evicts) evictions <= evictions + 1;
        if (step == 63) begin
          phase <= block == BLOCKS - 1 ? CHECK : START;
          block <= block == BLOCKS - 1 ? block : block + 1;
          step <= 0;
        end
      end
      CHECK: begin
        if (slot != fvc_after[entry]) fail("FVC slot differs", step);
        if (step == ENTRIES - 1) begin
          phase <= DONE;
          $display("PASS %0d blocks, %0d hits, %0d evictions", BLOCKS, hits, evictions);
          $finish;
        end
      end
      default: ;
    endcase
  end
endmodule
