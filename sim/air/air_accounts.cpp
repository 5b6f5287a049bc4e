#include "sim/air/air_accounts.h"

#include <algorithm>

namespace sim::air {
namespace {

/// Further accounts, which only invalid data can cause, are merged into one per transmitter and
/// purpose.
constexpr std::size_t kMostAccounts = 1U << 18U;

}  // namespace

void share_out(std::int64_t whole, std::span<const Piece> pieces,
               std::vector<std::int64_t>& parts) {
  parts.assign(pieces.size(), whole);
  if (pieces.size() < 2) return;
  std::int64_t total = 0;
  for (const Piece& piece : pieces) total += piece.octets;
  std::int64_t left = whole;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    parts[i] = whole * pieces[i].octets / total;
    left -= parts[i];
  }
  const auto remainder = [&](std::size_t i) { return whole * pieces[i].octets % total; };
  std::vector<std::size_t> order(pieces.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::stable_sort(order, std::ranges::greater{}, remainder);
  for (std::int64_t i = 0; i < left; ++i) ++parts[order[static_cast<std::size_t>(i)]];
}

void AirAccounts::open(const Content& content, hal::AgentId transmitter, Shares& shares) {
  shares.clear();
  for (const Piece& piece : content.pieces) {
    AirKind kind = piece.kind;
    if (all_.size() >= kMostAccounts) kind = {.purpose = kind.purpose, .what = kMalformed};
    const Key key{transmitter, kind};
    const auto [place, is_new] = places_.try_emplace(key, static_cast<std::uint32_t>(all_.size()));
    if (is_new) all_.push_back({.transmitter = transmitter, .kind = kind});
    Share share{.account = place->second};
    const bool is_known = piece.writer != 0 && writers_.size() < kMostAccounts;
    const auto [writer, is_new_writer] = writer_places_.try_emplace(
        {is_known ? piece.writer : 0, key}, static_cast<std::uint32_t>(writers_.size()));
    if (is_new_writer) {
      writers_.push_back({.transmitter = transmitter, .writer = writer->first.first, .kind = kind});
    }
    share.writer = writer->second;
    shares.push_back(share);
  }
}

void AirAccounts::add(const Content& content, const Sent& sent, Shares& shares) {
  std::vector<std::int64_t> bits;
  std::vector<std::int64_t> airtime;
  share_out(sent.bits, content.pieces, bits);
  share_out(sent.airtime.count(), content.pieces, airtime);
  for (std::size_t i = 0; i < shares.size(); ++i) {
    shares[i].bits = bits[i];
    shares[i].airtime_ns = airtime[i];
    AirAccount& account = all_[shares[i].account];
    WriterAccount& writer = writers_[shares[i].writer];
    const std::uint64_t begins = content.pieces[i].begins ? 1 : 0;
    (sent.is_retry ? account.repeated : account.submessages) += begins;
    (sent.is_retry ? writer.repeated : writer.submessages) += begins;
    account.bits += static_cast<std::uint64_t>(bits[i]);
    writer.bits += static_cast<std::uint64_t>(bits[i]);
    account.airtime += hal::Duration{airtime[i]};
    writer.airtime += hal::Duration{airtime[i]};
    note(account.changed);
    note(writer.changed);
  }
  AirAccount& main = all_[shares[content.main()].account];
  ++main.frames;
  main.retries += sent.is_retry ? 1 : 0;
}

void AirAccounts::cut(const Content& content, hal::Duration airtime, Shares& shares) {
  std::vector<std::int64_t> parts;
  share_out(airtime.count(), content.pieces, parts);
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const hal::Duration less{shares[i].airtime_ns - parts[i]};
    all_[shares[i].account].airtime -= less;
    writers_[shares[i].writer].airtime -= less;
    note(all_[shares[i].account].changed);
    note(writers_[shares[i].writer].changed);
    shares[i].airtime_ns = parts[i];
  }
}

/// Receivers are numbered in order of appearance, so the size of an account depends on their number
/// and not on their addresses.
std::size_t AirAccounts::number_of(hal::AgentId receiver) {
  if (receiver.value >= numbers_.size()) numbers_.resize(receiver.value + std::size_t{1});
  std::uint32_t& number = numbers_[receiver.value];
  if (number == 0) number = ++receivers_;
  return number - 1;
}

void AirAccounts::add_end(const Content& content, const Shares& shares, hal::AgentId receiver,
                          bool addressed, hal::Verdict verdict) {
  const std::size_t main = content.main();
  const std::size_t number = number_of(receiver);
  for (std::size_t i = 0; i < shares.size(); ++i) {
    auto& at = all_[shares[i].account].at;
    if (number >= at.size()) at.resize(number + 1);
    auto& ends = at[number];
    if (!ends) ends = std::make_unique<AirAccount::Ends>(AirAccount::Ends{.receiver = receiver});
    AirEnds& end = ends->ends[addressed ? 1 : 0][static_cast<std::size_t>(verdict)];
    note(ends->changed);
    end.frames += i == main ? 1 : 0;
    ++end.parts;
  }
}

}  // namespace sim::air
