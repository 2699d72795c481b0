"""Prices of products that complement or replace one another: what does nearsightedness lose?

Demand falls with the own price and rises with the last one; prices of related products lower it
(complements) or raise it (substitutes). Maximising revenue is minimising `constant - revenue`, a
sum of nonnegative costs, so that a ratio in cost becomes one in revenue: lemma `le:cr-rev` of the
paper, repaired.
"""

import nearsight as ns
from nearsight.lpc import promise
from nearsight.lpc.random_pricing import random_pricing
from nearsight.lpc.revenue import guarantee, revenue_ratio, safe_prices

WEEKS = 20
K, R = 3, 2  # weeks ahead, hops around


def main() -> None:
    """Price 60 products with LPC and with hindsight."""
    products = ns.parse_graph("grid:6x10")
    market = random_pricing(products, WEEKS, seed=7, gamma=0.1, carry=0.2, cap=0.9)
    problem = market.problem()
    print(f"{products.vertices} products, {products.edges} related pairs, {WEEKS} weeks")

    run = ns.simulate(problem, k=K, r=R)
    print(f"revenue of LPC with k = {K}, r = {R}: {market.revenue(run.x):.6f}")
    print(f"best revenue in hindsight: {market.revenue(run.optimum.x):.6f}")
    capped = (run.x == market.cap[..., None]).mean()
    print(f"prices at their cap: {100 * capped:.0f} %")

    excess = promise(problem, K, R).cr_minus_one
    if excess is None:
        raise SystemExit("no guarantee at these k and r")
    print(f"cost above the optimum: {run.ratio_minus_one:.2e}, promised at most {excess:.2e}")

    # the lemma needs a revenue that can be reached: from constants alone, or that of safe prices
    safe = market.revenue(safe_prices(market))
    plain = guarantee(market, 1 + excess).values["ratio"]
    better = guarantee(market, 1 + excess, revenue=safe).values["ratio"]
    lost = 1 - revenue_ratio(market, run.x, run.optimum.x)
    print(f"share of revenue lost: {lost:.2e}, promised at most {1 - plain:.2e}")
    print(f"safe prices earn {safe:.2f}; knowing that, at most {1 - better:.2e}")


if __name__ == "__main__":
    main()
