; Who stands at the table, and who is sterile: people wash, gown each other and change places.
(define (domain crew)
  (:requirements :adl)
  (:types person place - object surgeon nurse - person)
  (:predicates (stands ?p - person ?x - place) (clean ?p - person) (gowned ?p - person)
               (table ?x - place) (sink ?x - place))

  (:action wash
    :parameters (?p - person ?x - place)
    :precondition (and (stands ?p ?x) (sink ?x) (not (gowned ?p)))
    :effect (clean ?p))

  (:action gown
    :parameters (?n - nurse ?p - (either surgeon nurse) ?x - place)
    :precondition (and (stands ?n ?x) (stands ?p ?x) (not (= ?n ?p)) (clean ?p))
    :effect (gowned ?p))

  (:action walk
    :parameters (?p - person ?x - place ?y - place)
    :precondition (and (stands ?p ?x) (not (= ?x ?y)) (imply (table ?y) (gowned ?p)))
    :effect (and (stands ?p ?y) (not (stands ?p ?x))
                 (when (not (table ?y)) (not (gowned ?p)))))

  (:action touch
    :parameters (?p - person ?x - place)
    :precondition (and (stands ?p ?x) (exists (?q - person) (and (stands ?q ?x) (not (= ?p ?q)) (not (clean ?q)))))
    :effect (and (not (clean ?p)) (not (gowned ?p)))))
