#include "num/expansion.h"

#include <doctest/doctest.h>

#include <random>

#include "num/wide.h"
#include "support/dyadic.h"

using namespace wireskin;
using scenes::Dyadic;

namespace {

template <int N>
Dyadic exact_value(const Expansion<N>& e) {
  Dyadic sum;
  for (int i = 0; i < e.size; ++i) sum = sum + Dyadic(e.part[i]);
  return sum;
}

Dyadic exact_value(const TwoParts& p) {
  return Dyadic(p.high) + Dyadic(p.low);
}

bool equal(const Dyadic& a, const Dyadic& b) {
  return (a - b).sign() == 0;
}

// Non-zero parts that grow, each below the last bit of the next.
template <int N>
bool is_expansion(const Expansion<N>& e) {
  for (int i = 0; i < e.size; ++i) {
    if (e.part[i] == 0.0) return false;
    if (i == 0) continue;
    int exponent = 0;
    double part = std::frexp(e.part[i], &exponent);
    while (part != std::floor(part)) {
      part *= 2.0;
      --exponent;
    }
    if (!(std::fabs(e.part[i - 1]) < std::ldexp(1.0, exponent))) return false;
  }
  return true;
}

// Full mantissas, or few bits (ties, exact cancellation), over a wide range of exponents.
double random_double(std::mt19937_64* random) {
  double value = static_cast<double>(static_cast<int64_t>((*random)() >> 11)) * 0x1p-53;
  if ((*random)() % 3 == 0) value = std::floor(value * 8.0) / 8.0;
  const int exponent = static_cast<int>((*random)() % 120) - 60;
  return std::ldexp((*random)() % 2 == 0 ? value : -value, exponent);
}

}  // namespace

TEST_CASE("two_sum, fast_two_sum and two_product lose nothing") {
  std::mt19937_64 random(1);
  for (int i = 0; i < 20000; ++i) {
    const double a = random_double(&random), b = random_double(&random);
    CHECK(equal(exact_value(two_sum(a, b)), Dyadic(a) + Dyadic(b)));
    CHECK(two_sum(a, b).high == a + b);
    CHECK(equal(exact_value(two_product(a, b)), Dyadic(a) * Dyadic(b)));
    CHECK(two_product(a, b).high == a * b);
    const double big = std::fabs(a) > std::fabs(b) ? a : b, small = big == a ? b : a;
    CHECK(equal(exact_value(fast_two_sum(big, small)), Dyadic(a) + Dyadic(b)));
  }
}

TEST_CASE("sums, differences, scalings and products of expansions are exact") {
  std::mt19937_64 random(2);
  for (int i = 0; i < 5000; ++i) {
    const auto pick = [&] { return random_double(&random); };
    const Expansion<4> e = exact_difference(pick(), pick()) + exact_product(pick(), pick());
    const Expansion<4> f = exact_difference(pick(), pick()) - exact_difference(pick(), pick());
    const Dyadic exact_e = exact_value(e), exact_f = exact_value(f);
    const double factor = pick();
    CHECK(is_expansion(e));
    CHECK(is_expansion(f));
    CHECK(is_expansion(scale(e, factor)));
    CHECK(is_expansion(e * f));
    CHECK(equal(exact_value(scale(e, factor)), exact_e * Dyadic(factor)));
    CHECK(equal(exact_value(e + f), exact_e + exact_f));
    CHECK(equal(exact_value(e - f), exact_e - exact_f));
    CHECK(equal(exact_value(e * f), exact_e * exact_f));
    CHECK(((e * f).leading() > 0) - ((e * f).leading() < 0) == (exact_e * exact_f).sign());
    CHECK((e - e).size == 0);
    CHECK((e - e).leading() == 0.0);
  }
}

TEST_CASE("compact keeps the number, and leaves no more parts than its bits need") {
  std::mt19937_64 random(4);
  int shortened = 0;
  for (int i = 0; i < 3000; ++i) {
    const auto pick = [&] { return random_double(&random); };
    const Expansion<4> e = exact_product(pick(), pick()) + exact_product(pick(), pick());
    const Expansion<4> f = exact_product(pick(), pick()) - exact_difference(pick(), pick());
    const Expansion<32> whole = e * f;
    Expansion<32> compacted = whole;
    compact(&compacted);
    CHECK(is_expansion(compacted));
    CHECK(equal(exact_value(compacted), exact_value(e) * exact_value(f)));
    CHECK(compacted.size <= whole.size);
    // Factors are multiples of 2^-226 below 2^122.
    CHECK(compacted.size <= compact_parts(2, 348));
    shortened += compacted.size < whole.size;
    const double factor = pick();
    CHECK(equal(exact_value(scale(compacted, factor)), exact_value(whole) * Dyadic(factor)));
    CHECK(equal(exact_value(compacted - e), exact_value(whole) - exact_value(e)));
    CHECK(equal(exact_value(fitted<16>(whole)), exact_value(whole)));
  }
  CHECK(shortened > 1000);
}

TEST_CASE("parts that touch are parted: 2^53 + 1 and a half") {
  Expansion<4> e;
  for (const double part : {0x1p-80, 0.5, 0x1p+53 - 1.0}) e.push(part);
  compact(&e);
  CHECK(is_expansion(e));
  CHECK(e.size <= 3);
  CHECK(equal(exact_value(e), Dyadic(0x1p+53 - 1.0) + Dyadic(0.5) + Dyadic(0x1p-80)));
}

TEST_CASE("add_product adds products in a room that only compact makes enough") {
  std::mt19937_64 random(5);
  for (int i = 0; i < 2000; ++i) {
    const auto pick = [&] { return random_double(&random); };
    Expansion<compact_parts(2, 348) + 8> sum;
    Dyadic exact;
    for (int k = 0; k < 6; ++k) {
      const Expansion<4> e = exact_product(pick(), pick()) + exact_product(pick(), pick());
      const Expansion<4> f = exact_product(pick(), pick()) - exact_difference(pick(), pick());
      add_product(e, f, &sum);
      exact = exact + exact_value(e) * exact_value(f);
    }
    CHECK(is_expansion(sum));
    CHECK(equal(exact_value(sum), exact));
  }
}

TEST_CASE("the parts that exact_difference leaves are those that are there") {
  CHECK(exact_difference(3.0, 1.0).size == 1);
  CHECK(exact_difference(1.0, 1.0).size == 0);
  CHECK(exact_difference(1.0, 0x1p-80).size == 2);
}

TEST_CASE("pairs of doubles keep a relative error below 2^-100") {
  std::mt19937_64 random(3);
  for (int i = 0; i < 20000; ++i) {
    const TwoParts a = two_sum(random_double(&random), random_double(&random));
    const TwoParts b = two_product(random_double(&random), random_double(&random));
    const auto close = [](const TwoParts& computed, const Dyadic& exact) {
      const Dyadic error = exact_value(computed) - exact;
      const Dyadic bound = exact * Dyadic(exact.sign() * 0x1p-100);
      return (bound - error).sign() >= 0 && (bound + error).sign() >= 0;
    };
    CHECK(close(wide_sum(a, b), exact_value(a) + exact_value(b)));
    CHECK(close(wide_difference(a, b), exact_value(a) - exact_value(b)));
    CHECK(close(wide_product(a, b), exact_value(a) * exact_value(b)));
    CHECK(wide_difference(a, a).high == 0.0);
  }
}
