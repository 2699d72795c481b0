"""What can nobody beat? Lower bounds for any decentralised online algorithm, with instances."""

from .asymmetric import Asymmetric, asymmetric, asymmetric_excess
from .augmentation import Augmented, augmentation, augmented
from .claimed import Claimed
from .climb import Searched, search_couplings
from .constrained import Constrained, search_constrained
from .floor import Floor, floor
from .infinite import infinite_excess
from .joint import Joint
from .lemmas import central_binomial, entropy
from .rates import PrintedRates, Supremum, printed_rates, spatial_supremum, temporal_supremum
from .ring import Ring
from .rows import Row, Sandwich, Violation, write_csv
from .sandwich import sandwich
from .sources import Charges
from .spatial import Spatial
from .stated import Stated, stated_temporal_excess
from .team import conditional_policy, realisation, team_policy
from .temporal import Temporal
from .worst_case import WorstCase, worst_case

__all__ = [
    "Asymmetric",
    "Augmented",
    "Charges",
    "Claimed",
    "Constrained",
    "Floor",
    "Joint",
    "PrintedRates",
    "Ring",
    "Row",
    "Sandwich",
    "Searched",
    "Spatial",
    "Stated",
    "Supremum",
    "Temporal",
    "Violation",
    "WorstCase",
    "asymmetric",
    "asymmetric_excess",
    "augmentation",
    "augmented",
    "central_binomial",
    "conditional_policy",
    "entropy",
    "floor",
    "infinite_excess",
    "printed_rates",
    "realisation",
    "sandwich",
    "search_constrained",
    "search_couplings",
    "spatial_supremum",
    "stated_temporal_excess",
    "team_policy",
    "temporal_supremum",
    "worst_case",
    "write_csv",
]
