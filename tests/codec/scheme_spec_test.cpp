// Scheme specifications: what is understood, and what each error names.
#include "tilepress/scheme_spec.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "dcp/fvc_config.h"
#include "memory/size_classes.h"
#include "pixels/memory_lines.h"
#include "tilepress/scheme.h"

using namespace tilepress;

namespace {

SchemeSpec good(const std::string& text) {
  const auto spec = parse_scheme(text);
  EXPECT_TRUE(spec.has_value()) << text << ": " << (spec ? "" : spec.error().text);
  return spec ? *spec : SchemeSpec{};
}

std::string fault(const std::string& text) {
  const auto spec = parse_scheme(text);
  EXPECT_FALSE(spec.has_value()) << text;
  if (spec) return {};
  EXPECT_EQ(spec.error().kind, text.find("file=") == text.npos ? ErrorKind::kBadValue : ErrorKind::kFile);
  const std::string error = spec.error().text;
  EXPECT_EQ(error.find('\n'), std::string::npos) << "one line: " << error;
  EXPECT_NE(error.find("scheme '" + text + "'"), std::string::npos) << error;
  return error;
}

}  // namespace

TEST(SchemeSpec, ANameAloneTakesTheDefaultsOfThePaper) {
  const SchemeSpec spec = good("vdcp");
  EXPECT_EQ(spec.text, "vdcp");
  EXPECT_EQ(spec.name, "vdcp");
  EXPECT_EQ(fvc_config(spec).entries, 64u);
  EXPECT_EQ(fvc_config(spec).policy, FvcPolicy::kLfc);
  EXPECT_EQ(fvc_config(spec).ways_per_set(), 64u);
  EXPECT_EQ(fvc_config(spec).sample, 1u);
  EXPECT_EQ(fvc_config(spec).period, 1u);
  EXPECT_EQ(spec.share("coverage"), 0.0);
}

TEST(SchemeSpec, TakesEveryKeyOfTheFamily) {
  const SchemeSpec spec = good("hdcp:fvc=128,policy=2lfc,ways=8,sample=16,period=3,coverage=0.7");
  EXPECT_EQ(fvc_config(spec).entries, 128u);
  EXPECT_EQ(fvc_config(spec).policy, FvcPolicy::k2Lfc);
  EXPECT_EQ(fvc_config(spec).ways_per_set(), 8u);
  EXPECT_EQ(fvc_config(spec).sample, 16u);
  EXPECT_EQ(fvc_config(spec).period, 3u);
  EXPECT_EQ(spec.share("coverage"), 0.7);
  EXPECT_EQ(fvc_config(good("dcp:policy=lru")).policy, FvcPolicy::kLru);
  EXPECT_EQ(fvc_config(good("dcp:policy=random")).policy, FvcPolicy::kRandom);
  EXPECT_EQ(fvc_config(good("dcp:fvc=2")).entries, 2u);
  EXPECT_EQ(fvc_config(good("dcp:fvc=1024")).entries, 1024u);
  EXPECT_EQ(good("dcp:coverage=1").share("coverage"), 1.0);
}

TEST(SchemeSpec, TakesTheKeysOfRas) {
  EXPECT_EQ(good("ras:ycocg=1").number("ycocg"), 1u);
  EXPECT_EQ(good("ras:ycocg=0").number("ycocg"), 0u);
  EXPECT_EQ(static_cast<SizeChoice>(good("ras:sizes=2").number("sizes")), SizeChoice::kTwo);
  EXPECT_EQ(static_cast<SizeChoice>(good("ras:sizes=3").number("sizes")), SizeChoice::kThree);
  EXPECT_EQ(static_cast<SizeChoice>(good("ras:sizes=burst,ycocg=1").number("sizes")), SizeChoice::kBurst);
}

TEST(SchemeSpec, TakesTheKeysOfTheFurtherSchemes) {
  EXPECT_EQ(good("palette").number("entries"), 64u);
  EXPECT_EQ(good("palette:from=first,entries=16").number("entries"), 16u);
  EXPECT_EQ(good("fbc:entries=1024").number("entries"), 1024u);
  EXPECT_EQ(line_order(good("bdi")), LineOrder::kRaster);
  EXPECT_EQ(line_order(good("bdi:order=quad")), LineOrder::kQuad);
  EXPECT_EQ(line_order(good("bpc:order=raster")), LineOrder::kRaster);
}

TEST(SchemeSpec, AFullyAssociativeFvcIsOneConfigurationHoweverItIsWritten) {
  EXPECT_EQ(fvc_config(good("dcp:ways=64")), fvc_config(good("dcp")));
  EXPECT_FALSE(fvc_config(good("dcp:ways=32")) == fvc_config(good("dcp")));
}

TEST(SchemeSpec, ErrorsNameTheFault) {
  const std::pair<const char*, const char*> faults[] = {
      {"", "unknown scheme ''"},
      {"zip", "unknown scheme 'zip' (there are dcp,"},
      {"VDCP", "unknown scheme 'VDCP'"},
      {"vdcp ", "unknown scheme 'vdcp '"},
      {"vdcp:", "nothing after ':'"},
      {"vdcp:fvc=64,", "nothing after the last ','"},
      {"vdcp:fvc", "'fvc' is not key=value"},
      {"vdcp:,fvc=64", "'' is not key=value"},
      {"vdcp:size=64", "unknown key 'size'"},
      {"vdcp:ycocg=1", "unknown key 'ycocg'"},
      {"ras:fvc=64", "unknown key 'fvc'"},
      {"red:fvc=64", "unknown key 'fvc'"},
      {"vdcp:fvc=", "fvc=: must be a power of two from 2 to 1024"},
      {"vdcp:fvc=1", "fvc=1: must be a power of two from 2 to 1024"},
      {"vdcp:fvc=48", "fvc=48: must be a power of two from 2 to 1024"},
      {"vdcp:fvc=2048", "fvc=2048: must be"},
      {"vdcp:fvc=64x", "fvc=64x: must be"},
      {"vdcp:fvc= 64", "fvc= 64: must be"},
      {"vdcp:fvc=-64", "fvc=-64: must be"},
      {"vdcp:fvc=99999999999999999999", "must be a power of two"},
      {"vdcp:policy=lfu", "policy=lfu: must be lfc, 2lfc, lru or random"},
      {"vdcp:ways=3", "ways=3: must divide the FVC size 64"},
      {"vdcp:ways=128", "ways=128: must divide the FVC size 64"},
      {"vdcp:ways=0", "ways=0: must be"},
      {"vdcp:sample=0", "sample=0: must be a whole number from 1"},
      {"vdcp:period=0", "period=0: must be a whole number from 1"},
      {"vdcp:coverage=1.1", "coverage=1.1: must be a number from 0 to 1"},
      {"vdcp:coverage=-0.1", "coverage=-0.1: must be"},
      {"vdcp:coverage=nan", "coverage=nan: must be"},
      {"vdcp:fvc=64,fvc=64", "key 'fvc' given twice"},
      {"ras:ycocg=2", "ycocg=2: must be 0 or 1"},
      {"palette:entries=3", "entries=3: must be a power of two from 2 to 1024"},
      {"palette:from=last", "from=last: must be first"},
      {"palette:file=", "file=: no such file"},
      {"palette:order=quad", "unknown key 'order'"},
      {"fbc:from=first", "unknown key 'from'"},
      {"te:fvc=64", "unknown key 'fvc'"},
      {"bdi:order=tile", "order=tile: must be raster or quad"},
      {"ras:sizes=4", "sizes=4: must be 3, 2 or burst"},
  };
  for (const auto& [text, named] : faults) {
    const std::string error = fault(text);
    EXPECT_NE(error.find(named), std::string::npos) << text << " gives: " << error;
  }
}

namespace {

/// The names that a text with lists stands for, each followed by a space; or the error.
std::string names_of(const std::string& text) {
  const auto specs = parse_schemes(text);
  if (!specs) return specs.error().text;
  std::string names;
  for (const SchemeSpec& spec : *specs) {
    EXPECT_EQ(parse_scheme(spec.text)->values, spec.values) << spec.text;
    names += spec.text + " ";
  }
  return names;
}

}  // namespace

TEST(SchemeSpec, AListStandsForTheSpecificationsTypedOneByOne) {
  EXPECT_EQ(names_of("vdcp"), "vdcp ");
  EXPECT_EQ(names_of("vdcp:fvc=16"), "vdcp:fvc=16 ");
  EXPECT_EQ(names_of("vdcp:fvc={16,64,32}"), "vdcp:fvc=16 vdcp:fvc=64 vdcp:fvc=32 ");
  EXPECT_EQ(names_of("vdcp:policy={lru,random},coverage=0.5"),
            "vdcp:policy=lru,coverage=0.5 vdcp:policy=random,coverage=0.5 ");
  EXPECT_EQ(names_of("ras:ycocg={0,1}"), "ras:ycocg=0 ras:ycocg=1 ");
  EXPECT_EQ(names_of("vdcp:fvc={16}"), "vdcp:fvc=16 ");
}

TEST(SchemeSpec, SeveralListsMultiplyAndTheLastKeyVariesFastest) {
  EXPECT_EQ(names_of("dcp:fvc={16,32},sample={1,4}"),
            "dcp:fvc=16,sample=1 dcp:fvc=16,sample=4 dcp:fvc=32,sample=1 dcp:fvc=32,sample=4 ");
}

TEST(SchemeSpec, EqualNamesOfAListAppearOnce) {
  EXPECT_EQ(names_of("dcp:fvc={16,32,16}"), "dcp:fvc=16 dcp:fvc=32 ");
}

TEST(SchemeSpec, RangesDoubleForSizesAndCountForSamplingAndPeriods) {
  EXPECT_EQ(names_of("dcp:fvc={16..128}"), "dcp:fvc=16 dcp:fvc=32 dcp:fvc=64 dcp:fvc=128 ");
  EXPECT_EQ(names_of("dcp:fvc={512..1023}"), "dcp:fvc=512 ");
  EXPECT_EQ(names_of("dcp:ways={1..4}"), "dcp:ways=1 dcp:ways=2 dcp:ways=4 ");
  EXPECT_EQ(names_of("fbc:entries={2..4}"), "fbc:entries=2 fbc:entries=4 ");
  EXPECT_EQ(names_of("dcp:sample={3..5}"), "dcp:sample=3 dcp:sample=4 dcp:sample=5 ");
  EXPECT_EQ(names_of("dcp:period={9..9}"), "dcp:period=9 ");
}

TEST(SchemeSpec, FullWaysMeanFullyAssociative) {
  EXPECT_EQ(fvc_config(good("dcp:ways=full")), fvc_config(good("dcp")));
  EXPECT_EQ(names_of("dcp:ways={32,full}"), "dcp:ways=32 dcp:ways=full ");
}

TEST(SchemeSpec, ErrorsOfListsNameTheFault) {
  const std::pair<const char*, const char*> faults[] = {
      {"vdcp:fvc={}", "fvc: a value of the list is empty"},
      {"vdcp:fvc={16,}", "fvc: a value of the list is empty"},
      {"vdcp:fvc={16,,32}", "fvc: a value of the list is empty"},
      {"vdcp:fvc={16", "fvc: '{' without '}'; a list has no spaces"},
      {"vdcp:fvc={16,{32}}", "fvc: a list inside a list"},
      {"vdcp:fvc={16}32", "fvc: text after '}'"},
      {"vdcp:fvc={16,48}", "scheme 'vdcp:fvc=48': fvc=48: must be a power of two"},
      {"vdcp:fvc={64..16}", "fvc: the range is reversed"},
      {"vdcp:fvc={16..}", "fvc: a range is {A..B}"},
      {"vdcp:ways={0..4}", "ways: a range is {A..B} with whole numbers from 1 on"},
      {"vdcp:policy={lfc..lru}", "policy: takes a list such as {a,b}, no range"},
      {"vdcp:coverage={0..1}", "coverage: takes a list such as {a,b}, no range"},
      {"vdcp:fvc={16,32},", "nothing after the last ','"},
      {"vdcp:{16,32}", "'{16' is not key=value"},
      {"vdcp:size={16,32}", "unknown key 'size'"},
      {"{vdcp,dcp}:fvc=16", "unknown scheme '{vdcp,dcp}'"},
      {"palette:file={a,b}", "file={a: no such file"},
      {"vdcp:sample={1..257}", "more than 256 configurations"},
      {"vdcp:sample={1..4294967295}", "more than 256 configurations"},
      {"vdcp:sample={1..16},period={1..17}", "more than 256 configurations"},
  };
  for (const auto& [text, named] : faults) {
    const std::string error = names_of(text);
    EXPECT_NE(error.find(named), std::string::npos) << text << " gives: " << error;
    EXPECT_EQ(error.find("scheme '"), 0u) << error;
  }
  EXPECT_EQ(parse_schemes("vdcp:sample={1..256}")->size(), 256u);
}

TEST(SchemeSpec, TheDefaultIsThePapersSevenInTheirOrder) {
  std::string names;
  for (const SchemeSpec& spec : default_schemes()) names += spec.text + " ";
  EXPECT_EQ(names, "dcp adcp vdcp huffdcp ras red hdcp ");
}

TEST(Registry, EverySchemeIsDescribedAndMakesBothSides) {
  std::set<std::string> names;
  for (const SchemeInfo& info : scheme_registry()) {
    EXPECT_TRUE(names.insert(info.name).second) << info.name;
    EXPECT_GT(std::string(info.label).size(), 1u);
    EXPECT_GT(std::string(info.summary).size(), 10u) << info.name;
    EXPECT_GT(std::string(info.source).size(), 3u) << info.name;
    EXPECT_EQ(find_scheme(info.name), &info);
    const SchemeSpec spec = good(info.name);
    for (const PixelFormat format : {PixelFormat::kRgba8, PixelFormat::kRgb565, PixelFormat::kRgb10a2}) {
      EXPECT_NE(info.make_encoder(spec, traits(format), {}), nullptr);
      EXPECT_NE(info.make_decoder(spec, traits(format), {}), nullptr);
    }
  }
  EXPECT_EQ(find_scheme("nothing"), nullptr);
}
