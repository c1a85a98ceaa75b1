// Stored surface: bits out of the planes, pixels through the reader.
#include "stored_surface.h"

#include <algorithm>

#include "tilepress/bit_io.h"

namespace tilepress::python {
namespace {

Error no_such(const char* what, uint32_t x, uint32_t y) {
  return {ErrorKind::kBadValue, std::string(what) + " (" + std::to_string(x) + ", " + std::to_string(y) +
                                    "): outside of the surface"};
}

const Error kDamaged{ErrorKind::kBadBits, "surface: a block does not decode"};

std::string bits_in_bytes(BitReader bits, uint64_t count) {
  std::string bytes((count + 7) / 8, '\0');
  std::span<uint8_t> out(reinterpret_cast<uint8_t*>(bytes.data()), bytes.size());
  BitWriter writer(out);
  for (uint64_t done = 0; done < count; done += 8) {
    const auto take = static_cast<uint32_t>(std::min<uint64_t>(8, count - done));
    writer.put(bits.get(take), take);
  }
  writer.flush();
  return bytes;
}

}  // namespace

uint64_t StoredSurface::number_of(uint32_t bx, uint32_t by) const {
  if (bx >= surface_.blocks_x() || by >= surface_.blocks_y()) throw LibraryError(no_such("block", bx, by));
  return uint64_t{by} * surface_.blocks_x() + bx;
}

py::bytes StoredSurface::payload(uint32_t bx, uint32_t by) const {
  const uint64_t number = number_of(bx, by);
  const uint8_t* slot = surface_.payload.data() + number * surface_.slot_bytes();
  return py::bytes(reinterpret_cast<const char*>(slot), (surface_.block_bits[number] + 7u) / 8);
}

py::bytes StoredSurface::csb(uint32_t bx, uint32_t by) const {
  BitReader bits(surface_.csb);
  bits.skip(number_of(bx, by) * surface_.csb_bits);
  return bits_in_bytes(bits, surface_.csb_bits);
}

void StoredSurface::open() {
  if (!open_) require(reader_.open(surface_, {}));
  open_ = true;
}

py::array StoredSurface::read(uint32_t x, uint32_t y, uint32_t width, uint32_t height) {
  if (width < 1 || height < 1 || uint64_t{x} + width > surface_.width ||
      uint64_t{y} + height > surface_.height)
    throw LibraryError(no_such("rectangle at", x, y));
  std::vector<uint32_t> words;
  {
    const py::gil_scoped_release others_may_run;
    const std::lock_guard lock(reading_);
    open();
    if (!reader_.read_rect({x, y, width, height}, words)) throw LibraryError(kDamaged);
  }
  return pixels_of(words, width, height, surface_.format);
}

py::array StoredSurface::read_block(uint32_t bx, uint32_t by) {
  number_of(bx, by);
  Block block;
  {
    const py::gil_scoped_release others_may_run;
    const std::lock_guard lock(reading_);
    open();
    if (!reader_.read_block(bx, by, block)) throw LibraryError(kDamaged);
  }
  return pixels_of(block.pixels, kBlockSide, kBlockSide, surface_.format);
}

py::dict StoredSurface::traffic() {
  ReadTraffic traffic;
  {
    const py::gil_scoped_release others_may_run;
    const std::lock_guard lock(reading_);
    open();
    traffic = reader_.traffic();
  }
  py::dict out;
  out["blocks"] = traffic.blocks;
  out["payload_bursts"] = traffic.payload_bursts;
  out["csb_bursts"] = traffic.csb_bursts;
  out["table_bursts"] = traffic.table_bursts;
  out["raw_bursts"] = traffic.raw_bursts;
  out["csb_lookups"] = traffic.csb_lookups;
  out["csb_misses"] = traffic.csb_misses;
  return out;
}

namespace {

py::bytes bytes_of(const std::vector<uint8_t>& bytes) {
  return py::bytes(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

/// Properties with the numbers of the surface.
void bind_numbers(py::class_<StoredSurface>& type) {
  const struct {
    const char *name, *doc;
    uint64_t (*number)(const CompressedSurface&);
  } numbers[] = {
      {"width", "Pixels.", [](const CompressedSurface& s) { return uint64_t{s.width}; }},
      {"height", "Pixels.", [](const CompressedSurface& s) { return uint64_t{s.height}; }},
      {"frame", "Number of the frame, from 0.", [](const CompressedSurface& s) { return s.ordinal; }},
      {"tile_side", "Side of a render tile, pixels.",
       [](const CompressedSurface& s) { return uint64_t{s.tile_side}; }},
      {"burst_bits", "Size of a DRAM burst.",
       [](const CompressedSurface& s) { return uint64_t{s.burst_bits}; }},
      {"csb_bits", "Status bits of a block.",
       [](const CompressedSurface& s) { return uint64_t{s.csb_bits}; }},
      {"table_bits", "Bits of the tables; 0 = none.",
       [](const CompressedSurface& s) { return s.table_bits; }},
      {"slot_bytes", "Size of a slot.", [](const CompressedSurface& s) { return uint64_t{s.slot_bytes()}; }},
      {"blocks_x", "Columns of blocks.", [](const CompressedSurface& s) { return uint64_t{s.blocks_x()}; }},
      {"blocks_y", "Rows of blocks.", [](const CompressedSurface& s) { return uint64_t{s.blocks_y()}; }},
  };
  for (const auto& each : numbers)
    type.def_property_readonly(
        each.name, [number = each.number](const StoredSurface& self) { return number(self.surface()); },
        each.doc);
}

void bind_arrays(py::class_<StoredSurface>& type) {
  type.def_property_readonly(
      "block_bits",
      [](const py::object& self) {
        const auto& surface = self.cast<const StoredSurface&>().surface();
        return array_over(surface.block_bits.data(), {surface.blocks_y(), surface.blocks_x()}, self);
      },
      "Payload bits of each block: (blocks_y, blocks_x) uint16, read-only, not copied.");
  type.def_property_readonly(
      "slots",
      [](const py::object& self) {
        const auto& surface = self.cast<const StoredSurface&>().surface();
        return array_over(surface.payload.data(),
                          {surface.blocks_y(), surface.blocks_x(), surface.slot_bytes()}, self);
      },
      "The slots: (blocks_y, blocks_x, slot_bytes) uint8, read-only, not copied.");
}

}  // namespace

void bind_surface(py::module_& module) {
  py::class_<StoredSurface> type(
      module, "CompressedSurface",
      "A frame as memory holds it after compression. Engine.process makes it.\n\n"
      "Blocks lie in slots of slot_bytes bytes, the size of a raw block in whole bursts. "
      "CSB and tables are bit strings, the highest bit of a byte first.");
  bind_numbers(type);
  type.def_property_readonly(
          "scheme", [](const StoredSurface& self) { return self.surface().scheme.text; },
          "The specification.")
      .def_property_readonly(
          "format", [](const StoredSurface& self) { return traits(self.surface().format).name; },
          "RGBA8, RGBX8, RGB565 or RGB10A2.")
      .def_property_readonly(
          "tables", [](const StoredSurface& self) { return bytes_of(self.surface().tables); },
          "The tables that go with the frame, table_bits bits.")
      .def_property_readonly(
          "csb_plane", [](const StoredSurface& self) { return bytes_of(self.surface().csb); },
          "The status bits of all blocks in raster order, csb_bits each, without gaps.");
  bind_arrays(type);
  type.def("payload", &StoredSurface::payload, py::arg("bx"), py::arg("by"),
           "Returns the payload of block column bx and row by, in whole bytes. Raises Error outside of the "
           "surface.")
      .def("csb", &StoredSurface::csb, py::arg("bx"), py::arg("by"),
           "Returns the status bits of a block, in whole bytes. Raises Error outside of the surface.")
      .def(
          "decode",
          [](StoredSurface& self) { return self.read(0, 0, self.surface().width, self.surface().height); },
          "Returns the frame, restored from slots, CSB and tables alone: an array like the one compressed, "
          "in the "
          "order R, G, B, A. Raises Error for schemes that need the frame before.")
      .def("read", &StoredSurface::read, py::arg("x"), py::arg("y"), py::arg("width"), py::arg("height"),
           "Returns the pixels of a rectangle. Raises Error outside of the surface.")
      .def("read_block", &StoredSurface::read_block, py::arg("bx"), py::arg("by"),
           "Returns the 8x8 pixels of a block, padding included. Raises Error outside of the surface.")
      .def_property_readonly(
          "traffic", &StoredSurface::traffic,
          "What decode, read and read_block fetched so far, in bursts: a dict with blocks, payload_bursts, "
          "csb_bursts, table_bursts, raw_bursts, csb_lookups and csb_misses.");
}

}  // namespace tilepress::python
