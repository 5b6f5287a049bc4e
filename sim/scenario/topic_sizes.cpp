#include "sim/scenario/topic_sizes.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "hal/files/config/value.h"
#include "hal/types/overloaded.h"

namespace sim::scenario {
namespace {

constexpr Range kSampleRange{kLeastSample, kMostSample};  // bytes
constexpr Range kRates{1e-3, 1e5};                        // Hz

const Key kSize{
    "size",
    "Size of each sample as serialised, with the CDR header of 4 bytes; a multiple of 4 "
    "is on the air as it is, others are padded by DDS. A list, [1 kB, 2 kB], is used in "
    "turn; of a range, {from: 1 kB, to: 3 kB}, each sample's size is drawn.",
    "8 kB", hal::files::config::kMustBeGiven};

std::uint32_t whole_bytes(Mapping& in, double bytes) {
  if (bytes != std::floor(bytes))
    in.mistake("size", fmt::format("{} B is not a whole number of bytes", bytes));
  return static_cast<std::uint32_t>(bytes);
}

SampleSizes size_list(Mapping& in) {
  std::vector<std::uint32_t> sizes;
  for (const hal::files::config::Scalar& one : in.texts(kSize)) {
    const auto bytes =
        hal::files::config::parse_value(one.text, "B", kSampleRange.low, kSampleRange.high);
    if (!bytes) in.mistake("size", bytes.error().message);
    sizes.push_back(bytes ? whole_bytes(in, *bytes) : kLeastSample);
  }
  if (sizes.empty()) {
    in.mistake("size", "must have at least one size");
    sizes.push_back(kLeastSample);
  }
  return sizes;
}

SampleSizes size_range(Mapping& in) {
  Mapping range = in.mapping(kSize);
  const auto limit = [&](const Key& key) {
    return whole_bytes(in, range.number(key, "B", kSampleRange));
  };
  SizeRange sizes{limit({"from", "Smallest size.", "1 kB"}),
                  limit({"to", "Largest size.", "3 kB"})};
  range.finish();
  if (sizes.to < sizes.from) {
    range.mistake("to", fmt::format("{} B is below `from`, {} B", sizes.to, sizes.from));
    sizes.to = sizes.from;
  }
  return sizes;
}

SampleSizes read_sizes(Mapping& in) {
  if (in.has_mapping(kSize.name)) return size_range(in);
  if (in.has(kSize.name) && !in.has_scalar(kSize.name)) return size_list(in);
  return std::vector{whole_bytes(in, in.number(kSize, "B", kSampleRange))};
}

void write_sizes(Writer& out, const std::vector<std::uint32_t>& sizes) {
  if (sizes.size() == 1) return out.number(kSize.name, sizes.front(), "B");
  out.numbers(kSize.name, {sizes.begin(), sizes.end()}, "B");
}

void write_sizes(Writer& out, const SizeRange& sizes) {
  out.open(kSize.name);
  out.number("from", sizes.from, "B");
  out.number("to", sizes.to, "B");
  out.close();
}

constexpr const char* kOneOfThem = "must have either rate or poisson or bursts";

void periodic_keys(Fields& io, PeriodicSamples& c) {
  io.needed({"rate",
             "Samples are written at this rate, from a phase on that is drawn for each writer; or "
             "give `poisson` or `bursts`.",
             "10 Hz"},
            "Hz", kRates, c.rate);
  io.duration({"jitter",
               "With `rate`: each sample's deviation from its instant, uniform from minus this to "
               "this; at most half a period.",
               "5 ms"},
              {0, hal::files::config::kLongestDuration}, c.jitter);
  if (hal::to_seconds(c.jitter) > 0.5 / c.rate)
    io.mistake("jitter", "is above half a period, so that samples would change their order");
}

void poisson_keys(Fields& io, PoissonSamples& c) {
  io.needed({"poisson", "Samples are written at the instants of a Poisson process of this rate.",
             "10 Hz"},
            "Hz", kRates, c.rate);
}

void burst_keys(Fields& io, SampleBursts& c) {
  io.inside({"bursts", "Samples are written in bursts."}, [&](Fields& bursts) {
    bursts.needed({"rate", "Bursts begin at this rate, from a phase on that is drawn.", "1 Hz"},
                  "Hz", kRates, c.rate);
    bursts.needed_count({"samples", "Samples of each burst.", "20"}, 1, 1'000'000, c.samples);
    bursts.duration({"spacing", "Time between two samples of a burst.", "1 ms"},
                    {0, hal::files::config::kLongestDuration}, c.spacing);
    if (hal::to_seconds(c.spacing) * (c.samples - 1.0) > 1 / c.rate)
      bursts.mistake("spacing", "makes a burst longer than the time until the next one");
  });
}

}  // namespace

void size_key(Fields& io, SampleSizes& sizes) {
  io.own(
      kSize, {.kind = Form::Kind::kNumber, .unit = "B", .range = kSampleRange},
      [&](Mapping& in) { sizes = read_sizes(in); },
      [&](Writer& out) { std::visit([&](const auto& c) { write_sizes(out, c); }, sizes); });
}

void rhythm_keys(Fields& io, SampleRhythm& rhythm) {
  const auto periodic = [&](Fields& one) {
    periodic_keys(one, as<PeriodicSamples>(rhythm));
    for (const char* other : {"poisson", "bursts"}) one.unused(other, kOneOfThem);
  };
  const auto poisson = [&](Fields& one) {
    poisson_keys(one, as<PoissonSamples>(rhythm));
    for (const char* other : {"jitter", "bursts"}) one.unused(other, kOneOfThem);
  };
  const auto bursts = [&](Fields& one) {
    burst_keys(one, as<SampleBursts>(rhythm));
    one.unused("jitter", kOneOfThem);
  };
  const bool is_said =
      io.first_of({{"rate", std::holds_alternative<PeriodicSamples>(rhythm), periodic},
                   {"poisson", std::holds_alternative<PoissonSamples>(rhythm), poisson},
                   {"bursts", std::holds_alternative<SampleBursts>(rhythm), bursts}});
  if (!is_said) io.mistake("", kOneOfThem);
}

}  // namespace sim::scenario
