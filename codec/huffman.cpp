// Huffman codes over a dictionary.
#include "huffman.h"

#include <algorithm>
#include <functional>
#include <queue>
#include <utility>

namespace tilepress {

std::vector<uint8_t> huffman_lengths(std::span<const uint32_t> counts) {
  const size_t leaves = counts.size();
  std::vector<uint8_t> lengths(leaves, 0);
  if (leaves == 0) return lengths;
  if (leaves == 1) {
    lengths[0] = 1;
    return lengths;
  }
  using Node = std::pair<uint64_t, uint32_t>;  // count, id
  std::priority_queue<Node, std::vector<Node>, std::greater<>> open;
  for (uint32_t id = 0; id < leaves; ++id) open.push({counts[id], id});
  std::vector<uint32_t> parent(2 * leaves - 1, 0);
  uint32_t next_id = static_cast<uint32_t>(leaves);
  while (open.size() > 1) {
    const Node a = open.top();
    open.pop();
    const Node b = open.top();
    open.pop();
    parent[a.second] = parent[b.second] = next_id;
    open.push({a.first + b.first, next_id++});
  }
  std::vector<uint8_t> depth(next_id, 0);  // parents have larger ids than their children
  for (uint32_t id = next_id - 1; id-- > 0;) depth[id] = static_cast<uint8_t>(depth[parent[id]] + 1);
  std::copy_n(depth.begin(), leaves, lengths.begin());
  return lengths;
}

bool CanonicalCode::assign(std::span<const uint8_t> lengths) {
  lengths_.assign(lengths.begin(), lengths.end());
  codes_.assign(lengths.size(), 0);
  ordered_.clear();
  count_.fill(0);
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
      codes_[i] = code++;
      ordered_.push_back(static_cast<uint16_t>(i));
    }
  }
  return true;
}

bool CanonicalCode::read(BitReader& in, uint32_t& index) const {
  uint64_t code = 0;
  for (uint32_t length = 1; length <= kMaxHuffmanLength; ++length) {
    code = code << 1 | in.get(1);
    if (code >= first_code_[length] && code - first_code_[length] < count_[length]) {
      index = ordered_[first_rank_[length] + (code - first_code_[length])];
      return true;
    }
  }
  return false;
}

}  // namespace tilepress
