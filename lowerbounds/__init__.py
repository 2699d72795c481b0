"""What can nobody beat? Lower bounds for any decentralised online algorithm, with instances."""

from .asymmetric import Asymmetric, asymmetric, asymmetric_excess
from .claimed import Claimed
from .floor import Floor, floor
from .infinite import infinite_excess
from .joint import Joint
from .lemmas import central_binomial, entropy
from .ring import Ring
from .sources import Charges
from .spatial import Spatial
from .stated import Stated, stated_temporal_excess
from .team import conditional_policy, realisation, team_policy
from .temporal import Temporal

__all__ = [
    "Asymmetric",
    "Charges",
    "Claimed",
    "Floor",
    "Joint",
    "Ring",
    "Spatial",
    "Stated",
    "Temporal",
    "asymmetric",
    "asymmetric_excess",
    "central_binomial",
    "conditional_policy",
    "entropy",
    "floor",
    "infinite_excess",
    "realisation",
    "stated_temporal_excess",
    "team_policy",
]
