# The reference values of results/statistics: what R makes of the same data. Run once, by hand, where R
# is (Debian: r-base-core); the tests need none. Only base R; formulas are written out again here.
#
#   BARAKA_WRITE_RESAMPLES=1 build/release/tests/unit_results_statistics_test --gtest_filter='*Resamples*'
#   Rscript tests/statistics/reference.R
#
# Reads resamples_12.csv and resamples_50.csv beside it, which the first line writes; writes
# reference.json beside it.
arguments <- commandArgs(FALSE)
folder <- dirname(sub("^--file=", "", grep("^--file=", arguments, value = TRUE)))
RNGkind("Mersenne-Twister", "Inversion", "Rejection")
set.seed(2009)

samples <- list(
  skewed = exp(rnorm(12, log(0.01), 1.2)),        # delays, s
  normal = rnorm(50, 100, 15),
  tied = rep(c(3, 1, 4, 1, 5, 9, 2, 6), length.out = 50),
  large = 1e9 + c(1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1024, 2048),
  pair_first = rnorm(12, 20, 4),
  settling = c(10 * exp(-(0:59) / 12), rep(0, 143)) + rnorm(203, 5, 1),
  stationary = rnorm(200, 5, 1),
  drifting = 1:100 + rnorm(100)
)
samples$pair_second <- samples$pair_first * 0.9 + rnorm(12, 0.5, 1)

values <- list()
put <- function(name, ...) values[[name]] <<- c(...)

for (name in c("skewed", "normal", "tied", "large")) {
  x <- samples[[name]]
  put(paste0(name, ".moments"), length(x), mean(x), sd(x))
  for (level in c(0.9, 0.95, 0.99)) {
    put(sprintf("%s.t.%g", name, level), t.test(x, conf.level = level)$conf.int)
  }
  for (p in c(0, 0.05, 0.25, 0.5, 0.75, 0.95, 1)) {
    put(sprintf("%s.quantile.%g", name, p), quantile(x, p, type = 7))
  }
  n <- length(x)
  for (p in c(0.25, 0.5, 0.75)) {
    low <- qbinom(0.025, n, p)        # smallest with F(low) >= 0.025: F(low - 1) is below it
    high <- qbinom(0.975, n, p) + 1
    if (low < 1 || high > n) next
    put(sprintf("%s.order.%g", name, p), sort(x)[low], sort(x)[high],
        pbinom(high - 1, n, p) - pbinom(low - 1, n, p))
  }
}

for (df in c(1, 2, 3, 4, 9, 29, 99, 999)) {
  for (p in c(0.6, 0.9, 0.975, 0.995, 0.9995)) put(sprintf("qt.%g.%g", p, df), qt(p, df))
  put(sprintf("pt.%g", df), pt(-2.5, df))
}
for (p in c(1e-6, 0.025, 0.5, 0.8, 0.975)) put(sprintf("qnorm.%g", p), qnorm(p))
put("pnorm", pnorm(-1.7))

# The bootstrap, on the resamples of the C++ program.
resamples <- function(n) as.matrix(read.csv(file.path(folder, sprintf("resamples_%d.csv", n)),
                                            header = FALSE)) + 1
bca <- function(x, boot, statistic, level) {
  bias <- qnorm(mean(boot < statistic(x)))
  jack <- sapply(seq_along(x), function(i) statistic(x[-i]))
  off <- mean(jack) - jack
  skew <- sum(off^3) / (6 * sum(off^2)^1.5)
  z <- bias + qnorm(c((1 - level) / 2, (1 + level) / 2))
  quantile(boot, pnorm(bias + z / (1 - skew * z)), type = 7)
}
statistics <- list(mean = mean, median = median)
for (name in c("skewed", "normal", "tied", "large")) {
  x <- samples[[name]]
  index <- resamples(length(x))
  for (what in names(statistics)) {
    boot <- apply(index, 1, function(row) statistics[[what]](x[row]))
    put(sprintf("%s.percentile.%s", name, what), quantile(boot, c(0.025, 0.975), type = 7))
    if (name == "tied" && what == "median") next  # its jackknife does not vary
    put(sprintf("%s.bca.%s", name, what), bca(x, boot, statistics[[what]], 0.95))
  }
}

# Pairs.
test <- t.test(samples$pair_second, samples$pair_first, paired = TRUE)
difference <- samples$pair_second - samples$pair_first
put("pairs.t", mean(difference), sd(difference), test$conf.int, test$statistic, test$p.value,
    cor(samples$pair_first, samples$pair_second))
boot <- apply(resamples(12), 1, function(row) mean(difference[row]))
put("pairs.bca", bca(difference, boot, mean, 0.95))

# MSER-5: cut and whether it is the last one looked at.
mser <- function(x, batch) {
  count <- length(x) %/% batch
  means <- colMeans(matrix(x[1:(count * batch)], nrow = batch))
  cuts <- 0:(count %/% 2)
  error <- sapply(cuts, function(cut) {
    rest <- means[(cut + 1):count]
    sum((rest - mean(rest))^2) / length(rest)^2
  })
  best <- cuts[which.min(error)]
  c(best * batch, as.numeric(best == count %/% 2))
}
for (name in c("settling", "stationary", "drifting")) {
  put(sprintf("%s.mser", name), mser(samples[[name]], 5))
}

# %.17g gives back the same double.
numbers <- function(x) paste0("[", paste(sprintf("%.17g", x), collapse = ", "), "]")
object <- function(list) paste(sprintf("    \"%s\": %s", names(list), sapply(list, numbers)),
                               collapse = ",\n")
writeLines(sprintf("{\n  \"made_by\": \"%s\",\n  \"samples\": {\n%s\n  },\n  \"values\": {\n%s\n  }\n}",
                   R.version.string, object(samples), object(values)),
           file.path(folder, "reference.json"))
