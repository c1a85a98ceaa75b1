// Huffman codes over a dictionary.
#include "dictionary/huffman.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <functional>
#include <utility>

namespace tilepress {

void huffman_lengths(std::span<const uint32_t> counts, std::vector<uint8_t>& lengths) {
  constexpr size_t kMaxLeaves = 1025;
  const size_t leaves = counts.size();
  assert(leaves <= kMaxLeaves);
  lengths.assign(leaves, 1);
  if (leaves <= 1) return;
  using Node = std::pair<uint64_t, uint32_t>;  // count, id
  std::array<Node, kMaxLeaves> open;           // a heap, the smallest node on top
  for (uint32_t id = 0; id < leaves; ++id) open[id] = {counts[id], id};
  auto end = open.begin() + static_cast<ptrdiff_t>(leaves);
  std::make_heap(open.begin(), end, std::greater<>());
  std::array<uint16_t, 2 * kMaxLeaves> parent;
  auto next_id = static_cast<uint32_t>(leaves);
  while (end - open.begin() > 1) {
    std::pop_heap(open.begin(), end--, std::greater<>());
    const Node a = *end;
    std::pop_heap(open.begin(), end, std::greater<>());
    Node& b = end[-1];
    parent[a.second] = parent[b.second] = static_cast<uint16_t>(next_id);
    b = {a.first + b.first, next_id++};
    std::push_heap(open.begin(), end, std::greater<>());
  }
  std::array<uint8_t, 2 * kMaxLeaves> depth;
  depth[next_id - 1] = 0;  // the root; parents have larger ids than their children
  for (uint32_t id = next_id - 1; id-- > 0;) depth[id] = static_cast<uint8_t>(depth[parent[id]] + 1);
  std::copy_n(depth.begin(), leaves, lengths.begin());
}

bool CanonicalCode::assign(std::span<const uint8_t> lengths) {
  if (try_assign(lengths)) return true;
  try_assign({});
  return false;
}

bool CanonicalCode::try_assign(std::span<const uint8_t> lengths) {
  lengths_.assign(lengths.begin(), lengths.end());
  codes_.assign(lengths.size(), 0);
  ordered_.clear();
  count_.fill(0);
  table_.fill({});
  for (uint8_t length : lengths) {
    if (length == 0 || length > kMaxHuffmanLength) return false;
    ++count_[length];
  }
  uint64_t code = 0;
  for (uint32_t length = 1; length <= kMaxHuffmanLength; ++length) {
    code <<= 1;
    first_code_[length] = code;
    first_rank_[length] = static_cast<uint32_t>(ordered_.size());
    if (count_[length] == 0) continue;
    if (code + count_[length] > uint64_t{1} << length) return false;
    for (size_t i = 0; i < lengths.size(); ++i) {
      if (lengths[i] != length) continue;
      if (length <= kTableBits) {
        const uint32_t shift = kTableBits - length;
        std::fill_n(table_.begin() + static_cast<ptrdiff_t>(code << shift), size_t{1} << shift,
                    Entry{static_cast<uint16_t>(i), static_cast<uint8_t>(length)});
      }
      codes_[i] = code++;
      ordered_.push_back(static_cast<uint16_t>(i));
    }
  }
  return true;
}

bool CanonicalCode::find_long(uint64_t window, uint32_t& index, uint32_t& length) const {
  for (length = kTableBits + 1; length <= kMaxHuffmanLength; ++length) {
    const uint64_t code = window >> (64 - length);
    if (code < first_code_[length] || code - first_code_[length] >= count_[length]) continue;
    index = ordered_[first_rank_[length] + (code - first_code_[length])];
    return true;
  }
  return false;
}

}  // namespace tilepress
