"""Measurements: profiles against loops, bounds that hold and bounds that do not, resumption."""

import json

import networkx as nx
import numpy as np
import pytest

import nearsight as ns
from nearsight.bounds import Parameters, Setting, bounds_for
from nearsight.graphs import InputError, network_growth, parse_graph
from nearsight.perturbation import Promised, Runner, Spec, fit, measure, sensitivity
from nearsight.perturbation.neighbourhood import Neighbourhood
from nearsight.perturbation.slices import slices

P = Parameters(1, 2, 1, 0.5)
GRAPHS = [
    "path:9",
    "ring:9",
    "grid:5x5",
    "torus:4x4",
    "tree:2x3",
    "regular:3x12",
    "erdos-renyi:20x0.15",
    "barabasi-albert:20x2",
    "geometric:30x0.3",
    "ring-of-blocks:5x2",
    "star:7",
    "examples/data/ieee118.graphml",
]


@pytest.mark.parametrize("spec", ["grid:5x5", "erdos-renyi:20x0.15", "star:7"])
def test_neighbourhoods(spec):
    network = parse_graph(spec, seed=2)
    graph = nx.convert_node_labels_to_integers(network.to_networkx())
    for v in range(network.vertices):
        for r in (1, 2):
            around = Neighbourhood.of(network, v, r)
            assert set(around.members) == set(nx.ego_graph(graph, v, r))
            own = nx.relabel_nodes(
                graph.subgraph(around.members),
                dict(zip(around.members.tolist(), range(len(around.members)), strict=True)),
            )
            theirs = {tuple(sorted(e)) for e in own.edges}
            mine = nx.convert_node_labels_to_integers(around.network.to_networkx()).edges
            assert {tuple(sorted(e)) for e in mine} == theirs
            for i, u in enumerate(around.members):
                for j, w in enumerate(around.members):
                    assert around.distance[i, j] == nx.shortest_path_length(graph, u, w)


def test_a_profile_is_the_largest_of_plain_loops():
    network = parse_graph("grid:5x5")
    spec = Spec(network, P, 3, 2, n=2, seed=4)
    graph = nx.convert_node_labels_to_integers(network.to_networkx())
    distance = dict(nx.all_pairs_shortest_path_length(graph))
    expected = {}
    for i in range(12):
        drawn = spec.draw(i)
        found = sensitivity(drawn.window, drawn.y, drawn.z)
        for row, (t0, v0) in enumerate(found.free):
            for column, (tau, u) in enumerate(found.fixed):
                part = "bottom" if tau == 0 else "top" if tau == 3 else "lateral"
                ends = (int(drawn.around.members[w]) for w in (v0, u))
                key = (part, abs(int(t0) - int(tau)), distance[next(ends)][next(ends)])
                value = np.linalg.norm(found.derivative[row, :, column, :], 2)
                expected[key] = max(expected.get(key, 0.0), value)
    cells = {(c.part, c.dt, c.ds): c.measured_max for c in measure(spec, 12).profiles}
    assert cells.keys() == expected.keys()
    for key, value in expected.items():
        assert cells[key] == pytest.approx(value, rel=1e-12)


def test_bounds_are_those_of_the_theorems():
    growth = network_growth(parse_graph("ring:13"))
    promised = Promised(P, growth)
    dt, ds = np.array([1, 2, 3]), np.array([0, 1, 2])
    for part, constant in (("top", "C_1"), ("bottom", "C_2")):
        bounds = promised.bounds(part, dt, ds)
        for tier in ("stated", "repaired"):
            (theorem,) = (b for b in bounds_for("thm:networked-exp-decay") if b.tier == tier)
            values = theorem.evaluate(Setting(P, growth)).values
            direct = values[constant] * values["rho_T"] ** dt * values["rho_S"] ** ds
            np.testing.assert_allclose(bounds[tier], direct, rtol=1e-14)
    # the joint bound by brute force over its rates
    alpha, beta = np.meshgrid(np.linspace(0, 4, 801), np.linspace(0, 4, 801))
    a, x = 1.0, 1.0
    s = 1 - (np.cosh(alpha) - 1) * a - (np.cosh(beta) - 1) * x / 2
    for d, q in ((2, 1), (3, 2)):
        with np.errstate(divide="ignore", invalid="ignore"):
            entry = np.where(s > 0, np.exp(-alpha * (d - 1) - beta * q) / s, np.inf).min() * a / 2
        sharp = promised.bounds("top", np.array([d]), np.array([q]))["sharp"][0]
        axes = [
            max(1.0, (1 + np.sqrt(c)) ** 2 / (2 * c))
            * ((np.sqrt(c) - 1) / (np.sqrt(c) + 1)) ** steps
            for c, steps in ((1 + 2 * a, d - 1), (1 + x, q))
        ]
        gamma = (np.sqrt(1 + 2 * a) - 1) / (np.sqrt(1 + 2 * a) + 1)
        slices = a / (2 * np.sqrt(1 + a)) * gamma ** (d - 1)
        assert sharp == pytest.approx(min(entry, a / 2 * min(axes), slices), rel=1e-4)


@pytest.mark.parametrize("spec", GRAPHS)
def test_no_sharp_or_repaired_bound_is_exceeded(spec):
    network = parse_graph(spec, seed=1)
    for parameters, n, box in (
        (P, 1, None),
        (Parameters(1, 1, 4, 2), 2, None),
        (Parameters(0.5, 1, 0.05, 0.01), 1, (-0.5, 0.7)),
    ):
        found = measure(Spec(network, parameters, 3, 2, n=n, box=box, spread=2.0, seed=5), 12)
        guaranteed = {"repaired", "sharp", "tight"}
        assert not [cell for tier, cell in found.violations if tier in guaranteed]
        assert not [d for tier, d in found.slices.violations if tier in guaranteed]
        assert max(found.jumps["repaired"], found.jumps["sharp"]) <= 1


@pytest.mark.slow
@pytest.mark.parametrize("spec", GRAPHS)
def test_no_bound_is_exceeded_by_a_hundred_thousand(spec):
    # a night's run, 10^5 instances over all graphs: -m slow
    rng, network = np.random.default_rng(6), parse_graph(spec, seed=1)
    for _ in range(42):
        a, l_S = 10 ** rng.uniform(-2, 2, size=2)
        made = Parameters(1.0, 1 + 3 * rng.random(), a, l_S)
        k, r, n = int(rng.integers(2, 6)), int(rng.integers(1, 4)), int(rng.integers(1, 3))
        styles = ("attraction", "repulsion", "blocks", "tilted")
        found = measure(
            Spec(network, made, k, r, styles, n=n, seed=int(rng.integers(1 << 30))),
            200,
            runner=Runner(0),
        )
        assert {tier for tier, _ in found.violations} <= {"stated"}
        assert {tier for tier, _ in found.slices.violations} <= {"stated"}
        assert max(found.jumps["repaired"], found.jumps["sharp"]) <= 1


def test_the_printed_bound_is_caught_at_weak_couplings():
    found = ns.measure(graph="ring:9", mu=1, l_f=1, l_T=1, l_S=0.01, k=3, r=2, instances=30)
    cells = {(cell.part, cell.ds) for tier, cell in found.violations if tier == "stated"}
    assert {("top", 0), ("bottom", 0)} <= cells
    assert {tier for tier, _ in found.violations} == {"stated"}


def test_the_printed_global_bound_is_caught_below_its_threshold():
    found = ns.measure(graph="ring:9", mu=1, l_f=1, l_T=0.2, l_S=0.3, k=3, r=2, instances=30)
    assert ("stated", 1) in found.slices.violations
    above = ns.measure(graph="ring:9", mu=1, l_f=1, l_T=0.7, l_S=0.3, k=3, r=2, instances=30)
    assert not above.slices.violations


def test_slices_are_norms_of_the_dense_inverse():
    spec = Spec(parse_graph("ring:7"), P, 4, 2, styles=("blocks",), n=2, seed=8)
    problem = spec.draw(0).problem
    from nearsight.lpc.terms import Terms

    free = np.array([(0, t, v) for t in (1, 2, 3) for v in range(problem.N)])
    terms = Terms.of(problem, free)
    size, n = problem.N * 2, 2
    M, C = terms.hessian(np.zeros((len(free), n)), np.zeros((len(terms.fixed), n)))
    moves = -np.linalg.solve(M.toarray(), C.toarray())
    expected = np.full(4, np.nan)
    for row in range(3):
        for side, tau in enumerate((0, 4)):
            block = moves[row * size : (row + 1) * size, side * size : (side + 1) * size]
            d = abs(row + 1 - tau)
            expected[d] = np.fmax(expected[d], np.linalg.norm(block, 2))
    np.testing.assert_allclose(slices(problem, 4), expected, rtol=1e-10)


def test_jumps_are_distances_of_two_solutions():
    # the ratio of one instance, from two solves and a plain double sum over the boundary
    spec = Spec(parse_graph("grid:4x4"), P, 3, 2, styles=("blocks",), n=2, seed=3)
    drawn = spec.draw(0)
    rng = np.random.default_rng([3, 0, 1])
    size = 10 ** rng.uniform(-3, 1)
    dy, dz = (size * rng.normal(size=part.shape) for part in (drawn.y, drawn.z))
    window = drawn.window
    before, after = window.solve(drawn.y, drawn.z), window.solve(drawn.y + dy, drawn.z + dz)
    promised, worst = Promised(P, spec.growth), 0.0
    touching = {tuple(pair) for pair in window.terms.fixed[:, 1:].tolist()}
    pairs = [*zip(window.bottom, dy, strict=True), *zip(window.boundary, dz, strict=True)]
    for row, (t0, v0) in enumerate(window.free):
        total = 0.0
        for (tau, u), delta in pairs:
            if (int(tau), int(u)) not in touching:
                continue
            part = "bottom" if tau == 0 else "top" if tau == 3 else "lateral"
            at = np.array([abs(t0 - tau)]), np.array([drawn.around.distance[v0, u]])
            total += promised.bounds(part, *at)["sharp"][0] * np.linalg.norm(delta)
        worst = max(worst, np.linalg.norm(after[row] - before[row]) / total)
    assert spec.cells(0)[-1] == pytest.approx(worst, rel=1e-6)


def test_instances_do_not_depend_on_how_many_or_on_the_workers():
    spec = Spec(parse_graph("grid:6x6"), P, 3, 2, seed=9)
    few, many = measure(spec, 25), measure(spec, 45)
    for i in (0, 24):
        np.testing.assert_array_equal(spec.cells(i), spec.cells(i))
    assert all(
        a.measured_max <= b.measured_max for a, b in zip(few.profiles, many.profiles, strict=True)
    )
    two = measure(spec, 45, runner=Runner(2))
    assert two.profiles == many.profiles
    assert two.slices == many.slices
    assert two.fit == many.fit


def test_a_dask_cluster_gives_the_same_numbers():
    from distributed import LocalCluster

    spec = Spec(parse_graph("grid:6x6"), P, 3, 2, seed=9)
    here = measure(spec, 45)
    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster:
        there = measure(spec, 45, runner=Runner(cluster=cluster.scheduler_address))
    assert there.profiles == here.profiles
    assert there.fit == here.fit


def test_an_interrupted_run_goes_on(tmp_path):
    spec, file = Spec(parse_graph("ring:9"), P, 3, 2, seed=1), tmp_path / "units"
    whole = measure(spec, 70)

    class StopError(Exception):
        pass

    def stop(done, total):
        if done >= 40:
            raise StopError

    with pytest.raises(StopError):
        measure(spec, 70, checkpoint=file, progress=stop)
    kept = file.read_bytes()
    for torn in (kept, kept[:-5], kept + b"garbage", kept[:-9] + b"x" + kept[-8:]):
        file.write_bytes(torn)
        seen = []
        again = measure(spec, 70, checkpoint=file, progress=lambda d, t, s=seen: s.append(d))
        assert again.profiles == whole.profiles
        assert again.fit == whole.fit
        assert seen[0] == (60 if torn.startswith(kept) else 40)
    more = measure(spec, 90, checkpoint=file)
    assert more.profiles == measure(spec, 90).profiles


def test_a_file_of_something_else_is_refused(tmp_path):
    spec, file = Spec(parse_graph("ring:9"), P, 3, 2, seed=1), tmp_path / "units"
    measure(spec, 5, checkpoint=file)
    before = file.read_bytes()
    with pytest.raises(InputError, match="of another measurement"):
        measure(Spec(parse_graph("ring:9"), P, 3, 1, seed=1), 5, checkpoint=file)
    assert file.read_bytes() == before
    file.write_text("something else\n")
    with pytest.raises(InputError, match="no file of measurements"):
        measure(spec, 5, checkpoint=file)


def test_fits_recover_rates_and_their_intervals_cover():
    rng, covered = np.random.default_rng(3), 0
    dt, ds = np.meshgrid(np.arange(5), np.arange(6), indexing="ij")
    for seed in range(60):
        noise = rng.gumbel(size=(40, 3, 5, 6))
        cells = np.exp(0.2 * noise) * 0.3**dt * 0.05**ds
        found = fit(cells, seed)
        assert found.rho_T == pytest.approx(0.3, rel=0.1)
        assert found.rho_S == pytest.approx(0.05, rel=0.1)
        low, high = found.ci["rho_T"]
        covered += low <= 0.3 <= high
    assert covered >= 40  # largest values are biased alike in every cell: roughly 95 %
    exact = fit(np.broadcast_to(0.3**dt * 0.05**ds * 1e-200, (3, 3, 5, 6)))
    assert exact.rho_T == pytest.approx(0.3, rel=1e-12)


def test_one_distance_gives_no_rate():
    cells = np.full((4, 3, 2, 2), np.nan)
    cells[:, 0, 1, 0] = 0.3
    found = fit(cells)
    assert (found.rho_T, found.rho_S) == (None, None)
    assert "rho_T and rho_S" in found.reason


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"k": 1}, "k = 1: k >= 2 is needed"),
        ({"r": 0}, "r = 0: r >= 1 is needed"),
        ({"styles": ("magic",)}, "style = 'magic': one of attraction"),
        ({"seed": -1}, "seed = -1"),
        ({"spread": 0.0}, "spread = 0.0"),
        ({"spread": np.inf}, "spread = inf"),
    ],
)
def test_bad_specs(change, words):
    given = {"network": parse_graph("ring:5"), "parameters": P, "k": 2, "r": 1}
    with pytest.raises(InputError, match=words):
        Spec(**(given | change))


def test_json_is_plain():
    from nearsight.cli.measure import document

    found = measure(Spec(parse_graph("ring:9"), P, 3, 2), 6)
    read = json.loads(json.dumps(document(found)))
    assert {"dt", "ds", "part", "measured_max", "bounds"} <= read["profiles"][0].keys()
    assert {"stated", "repaired", "sharp"} <= read["profiles"][0]["bounds"].keys()
    assert {"rho_T", "rho_S", "ci"} <= read["fit"].keys()
